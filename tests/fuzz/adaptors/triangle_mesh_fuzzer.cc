// Feeds ReadTriangleMesh with whatever libFuzzer makes up, as a file, since OpenMesh reads files. It either returns a
// mesh that passes CheckTriangleMesh() or throws std::runtime_error with one line of text; all else is a finding.
// OCTUPOLE_FUZZ_ENDING names the format.

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "octupole/adaptors/triangle_mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path = "/dev/shm/octupole_fuzz_" + std::to_string(getpid()) + "." OCTUPOLE_FUZZ_ENDING;
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    std::vector<std::string> warnings;
    std::vector<int> faces;
    const octupole::TriangleMesh mesh = octupole::ReadTriangleMesh(path, &warnings, &faces);
    octupole::CheckTriangleMesh(mesh);
    if (faces.size() != mesh.triangles.size()) std::abort();
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    if (message.compare(0, path.size(), path) != 0 || message.find('\n') != std::string::npos) std::abort();
  }
  std::filesystem::remove(path);
  return 0;
}
