#include "output_files.h"

#include <ostream>
#include <stdexcept>

#include "octupole/io/atomic_file.h"

namespace octupole {

void CheckFolderOf(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  throw std::runtime_error(file.string() + ": there is no folder " + folder.string());
}

void WriteReport(const std::filesystem::path& file, const nlohmann::ordered_json& report) {
  if (file.empty()) return;
  WriteFileAtomically(file, [&](std::ostream& stream) { stream << report.dump(2) << "\n"; });
}

nlohmann::ordered_json DescribeAlignment(const BoundaryAlignment& alignment) {
  return {{"normals", alignment.num_normals},
          {"frames", alignment.num_frames},
          {"tangents", alignment.num_tangents},
          {"free", alignment.num_free}};
}

}  // namespace octupole
