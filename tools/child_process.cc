#include "child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "interruption.h"

namespace octupole {
namespace {

constexpr int kCannotStart = 127;

[[noreturn]] void Become(const std::vector<char*>& arguments, const char* error_file) {
  const int null = open("/dev/null", O_RDWR);
  const int errors = open(error_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (null >= 0 && errors >= 0 && dup2(null, 0) >= 0 && dup2(null, 1) >= 0 && dup2(errors, 2) >= 0) {
    execv("/proc/self/exe", arguments.data());
  }
  _exit(kCannotStart);
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildOutcome RunSelf(const std::vector<std::string>& arguments, const std::filesystem::path& error_file) {
  // All memory is allocated before the fork.
  std::vector<std::string> strings = {"octupole"};
  strings.insert(strings.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(strings.size() + 1);
  for (std::string& string : strings) pointers.push_back(string.data());
  pointers.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) Become(pointers, error_file.c_str());
  int status = 0;
  rusage usage = {};
  pid_t ended = -1;
  if (child > 0) {
    PassInterruptionsTo(child);
    do {
      ended = wait4(child, &status, 0, &usage);
    } while (ended < 0 && errno == EINTR);
    PassInterruptionsTo(0);
  }
  if (ended < 0) throw std::runtime_error(std::string("cannot start a process: ") + std::strerror(errno));
  ChildOutcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (outcome.exit_code == kCannotStart) throw std::runtime_error("cannot start /proc/self/exe");
  outcome.cpu_seconds = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
  outcome.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
  return outcome;
}

}  // namespace octupole
