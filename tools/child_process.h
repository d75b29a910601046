#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace octupole {

/// What a child process left.
struct ChildOutcome {
  /// 128 + the signal's number if a signal ended it, as shells have it.
  int exit_code = 0;
  /// User and system, of all its threads.
  double cpu_seconds = 0;
  /// The largest resident set. On Linux not less than that of the parent when it started the child.
  double peak_memory_mb = 0;
};

/// Runs this very program with other arguments and waits for it. Its output is dropped, its error messages go to a
/// file. What interrupts us ends it, too. \throw std::runtime_error when it cannot be started.
ChildOutcome RunSelf(const std::vector<std::string>& arguments, const std::filesystem::path& error_file);

}  // namespace octupole
