// Feeds one reader with whatever libFuzzer makes up. A reader either returns a mesh that passes CheckTetMesh() or
// throws std::runtime_error with one line of text; all else is a finding. OCTUPOLE_FUZZ_READER names the reader.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "octupole/readers/internal/mesh_readers.h"

namespace octupole::internal {
namespace {

/// The files of TetGen one behind the other, with a zero between them; the last may be missing.
[[maybe_unused]] ParsedMesh ReadTetGenFiles(const NamedText& files) {
  const auto part = [text = files.text]() mutable {
    const std::string_view part = text.substr(0, text.find('\0'));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    return part;
  };
  auto next = part;
  const NamedText nodes{"fuzz.node", next()};
  const NamedText elements{"fuzz.ele", next()};
  const NamedText edges{"fuzz.edge", next()};
  return ReadTetGen(nodes, elements, edges.text.empty() ? nullptr : &edges);
}

void Run(std::string_view text) {
  try {
    std::vector<std::string> warnings;
    CheckTetMesh(FinishMesh("fuzz", OCTUPOLE_FUZZ_READER({"fuzz", text}), &warnings));
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    if (message.substr(0, 4) != "fuzz" || message.find('\n') != std::string::npos) {
      std::abort();
    }
  }
}

}  // namespace
}  // namespace octupole::internal

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  octupole::internal::Run({reinterpret_cast<const char*>(data), size});
  return 0;
}
