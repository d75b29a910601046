#include "output_folder.h"

#include <stdexcept>

namespace octupole {

void CheckFolderOf(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  throw std::runtime_error(file.string() + ": there is no folder " + folder.string());
}

}  // namespace octupole
