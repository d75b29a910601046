#pragma once

namespace octupole {

/// While one of these lives, Ctrl-C does not end the program but is remembered; a second Ctrl-C ends it as usual.
class InterruptionGuard {
 public:
  InterruptionGuard();
  ~InterruptionGuard();
  InterruptionGuard(const InterruptionGuard&) = delete;
  InterruptionGuard& operator=(const InterruptionGuard&) = delete;

  bool IsInterrupted() const;
};

}  // namespace octupole
