#include "octupole/io/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <stdexcept>

#include "test_files.h"

namespace octupole {
namespace {

int NumFiles(const TemporaryFolder& folder) {
  const std::filesystem::directory_iterator begin(folder.path());
  return static_cast<int>(std::distance(begin, std::filesystem::directory_iterator()));
}

std::string WriteMessage(const std::filesystem::path& path, const std::string& text) {
  return MessageOf<std::runtime_error>([&] { WriteFileAtomically(path, [&](std::ostream& out) { out << text; }); });
}

TEST(WriteFileAtomically, WritesAndReplaces) {
  const TemporaryFolder folder;
  EXPECT_EQ(WriteMessage(folder / "a.txt", "first\n"), "");
  EXPECT_EQ(WriteMessage(folder / "a.txt", "second\r\n"), "");
  EXPECT_EQ(ReadText(folder / "a.txt"), "second\r\n");
  EXPECT_EQ(NumFiles(folder), 1);
}

TEST(WriteFileAtomically, KeepsTheOldFileIfTheWriterThrows) {
  const TemporaryFolder folder;
  WriteText(folder / "a.txt", "old");
  const std::string message = MessageOf<std::logic_error>([&] {
    WriteFileAtomically(folder / "a.txt", [&](std::ostream& out) {
      out << "new";
      throw std::logic_error("no more");
    });
  });
  EXPECT_EQ(message, "no more");
  EXPECT_EQ(ReadText(folder / "a.txt"), "old");
  EXPECT_EQ(NumFiles(folder), 1);
}

TEST(WriteFileAtomically, KeepsTheOldFileIfTheDiskIsFull) {
  const TemporaryFolder folder;
  WriteText(folder / "a.txt", "old");
  // A limit on the size of files fails in the same way as a full disk.
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const rlimit limit{1 << 16, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  const std::string message = WriteMessage(folder / "a.txt", std::string(1 << 20, 'x'));
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);

  EXPECT_EQ(message, (folder / "a.txt").string() + ": cannot be written: File too large");
  EXPECT_EQ(ReadText(folder / "a.txt"), "old");
  EXPECT_EQ(NumFiles(folder), 1);
}

TEST(WriteFileAtomically, FollowsLinksAndKeepsThem) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink("sub/second", folder / "first");
  std::filesystem::create_symlink("../target", folder / "sub/second");
  EXPECT_EQ(WriteMessage(folder / "first", "new"), "");
  EXPECT_EQ(ReadText(folder / "target"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "sub/second"));
  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_EQ(WriteMessage(folder / "circle", "x"),
            (folder / "circle").string() + ": cannot be written: Too many levels of symbolic links");
}

TEST(WriteFileAtomically, NamesWhatIsInTheWay) {
  const TemporaryFolder folder;
  EXPECT_EQ(WriteMessage(folder / "missing/a.txt", "x"),
            (folder / "missing/a.txt").string() + ": cannot be written: No such file or directory");
  std::filesystem::create_directory(folder / "b");
  EXPECT_EQ(WriteMessage(folder / "b", "x"), (folder / "b").string() + ": cannot be written: Is a directory");
  EXPECT_EQ(WriteMessage("/dev/null", "x"), "/dev/null: cannot be written: not a regular file");
  EXPECT_EQ(NumFiles(folder), 1);
}

}  // namespace
}  // namespace octupole
