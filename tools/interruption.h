#pragma once

#include <sys/types.h>

namespace octupole {

/// While one of these lives, Ctrl-C and SIGTERM do not end the program but are remembered; a second one of the same
/// ends it as usual.
class InterruptionGuard {
 public:
  InterruptionGuard();
  ~InterruptionGuard();
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;

  bool IsInterrupted() const;
  /// When interrupted, leaves the command, whose work is done as far as it came: throws what makes the program's exit
  /// code 128 + the signal's number, as shells have it.
  void ExitIfInterrupted() const;
};

/// From now on a remembered signal also ends this child process; 0 stands for none.
void PassInterruptionsTo(pid_t child);

}  // namespace octupole
