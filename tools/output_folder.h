#pragma once

#include <filesystem>

namespace octupole {

/// Throws std::runtime_error when there is no folder for a file that is to be written: to be asked before minutes are
/// spent on solving. The empty path, no file, passes.
void CheckFolderOf(const std::filesystem::path& file);

}  // namespace octupole
