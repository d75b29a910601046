#include "octupole/io/atomic_file.h"

#include <cerrno>
#include <fstream>
#include <locale>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>

namespace octupole {
namespace {

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& cause) {
  throw std::runtime_error(path.string() + ": cannot be written: " + cause);
}

std::string LastError() { return std::generic_category().message(errno); }

/// A file that is removed unless it has been renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : path_(target) {
    // Two programs that write the same file must not share the temporary one.
    path_ += "." + std::to_string(std::random_device()()) + ".tmp";
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

std::filesystem::path FollowLinks(const std::filesystem::path& path) {
  constexpr int kMaxLinks = 40;  // as in Linux
  std::filesystem::path target = path;
  for (int i = 0; std::filesystem::is_symlink(target); ++i) {
    if (i == kMaxLinks) Fail(path, std::generic_category().message(ELOOP));
    // A relative link counts from its own folder.
    target = target.parent_path() / std::filesystem::read_symlink(target);
  }
  return target;
}

void WriteFileAtomically(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write) {
  const std::filesystem::path target = FollowLinks(path);
  // A rename would replace a device such as /dev/null as well.
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) {
    Fail(path, std::generic_category().message(EISDIR));
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    Fail(path, "not a regular file");
  }
  const TemporaryFile temporary(target);
  errno = 0;
  std::ofstream file(temporary.path(), std::ios::binary);
  if (!file) {
    Fail(path, LastError());
  }
  file.imbue(std::locale::classic());
  write(file);
  file.close();
  if (!file) {
    Fail(path, LastError());
  }
  std::filesystem::rename(temporary.path(), target, error);
  if (error) {
    Fail(path, error.message());
  }
}

}  // namespace octupole
