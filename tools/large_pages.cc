#include "large_pages.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace octupole {
namespace {

bool IsLargeFile(const char* argument) {
  // A mesh of some 20,000 vertices: it takes longer than a start.
  constexpr std::uintmax_t kLargeFile = 4'000'000;
  std::error_code error;
  return std::filesystem::is_regular_file(argument, error) &&
         std::filesystem::file_size(argument, error) >= kLargeFile && !error;
}

}  // namespace

void UseLargePages(int argc, char** argv) {
  constexpr const char* kTunables = "GLIBC_TUNABLES";
  // A grid may be large whatever the file is.
  const bool is_grid = argc > 1 && std::string_view(argv[1]) == "grid";
  if (std::getenv(kTunables) != nullptr || (!is_grid && std::none_of(argv + 1, argv + argc, IsLargeFile))) return;
  setenv(kTunables,
         "glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=134217728:glibc.malloc.trim_threshold=8589934592",
         /*overwrite=*/0);
  execv("/proc/self/exe", argv);
  // Without /proc it goes on with small pages.
}

}  // namespace octupole
