#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace octupole {

/// Where a chain of symbolic links ends, be anything there or not; any other path as it is.
/// \throw std::runtime_error when it goes in a circle.
std::filesystem::path FollowLinks(const std::filesystem::path& path);

/// Writes a file so that there is never half of one under its name: `write` fills a temporary file
/// in the same folder, which then takes the name. If anything fails, an existing file is untouched
/// and the temporary one is removed. Where the name is a symbolic link, the file that it leads to is written. The
/// stream writes numbers as in C, whatever the global locale.
///
/// \throw std::runtime_error naming the path and the cause: the folder is missing or not writable,
/// the disk is full, or something other than a regular file has this name. What `write` throws
/// passes through.
void WriteFileAtomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace octupole
