#include "interruption.h"

#include <csignal>

namespace octupole {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void Remember(int /*signal*/) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

InterruptionGuard::InterruptionGuard() {
  interrupted = 0;
  std::signal(SIGINT, Remember);
}

InterruptionGuard::~InterruptionGuard() { std::signal(SIGINT, SIG_DFL); }

bool InterruptionGuard::IsInterrupted() const { return interrupted != 0; }

}  // namespace octupole
