#include "interruption.h"

#include <CLI/CLI.hpp>
#include <csignal>

namespace octupole {
namespace {

volatile std::sig_atomic_t received_signal = 0;
volatile pid_t child_process = 0;

void Remember(int signal) {
  received_signal = signal;
  std::signal(signal, SIG_DFL);
  if (child_process > 0) kill(child_process, SIGTERM);
}

}  // namespace

InterruptionGuard::InterruptionGuard() {
  received_signal = 0;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, Remember);
}

InterruptionGuard::~InterruptionGuard() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

bool InterruptionGuard::IsInterrupted() const { return received_signal != 0; }

void InterruptionGuard::ExitIfInterrupted() const {
  if (IsInterrupted()) throw CLI::RuntimeError(128 + received_signal);
}

void PassInterruptionsTo(pid_t child) {
  child_process = child;
  // The signal may have come before.
  if (child > 0 && received_signal != 0) kill(child, SIGTERM);
}

}  // namespace octupole
