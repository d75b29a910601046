#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace octupole::internal {

/// The whole content of a file.
class FileContent {
 public:
  /// \throw std::runtime_error with the operating system's reason if it cannot be read.
  explicit FileContent(const std::filesystem::path& path);

  std::string_view text() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;  // not a std::string, which would fill it with zeros first
  std::size_t size_;
};

/// Cuts a text into words at white space and reads numbers from them, in the C locale whatever the
/// process has set. Some formats have numbers in binary between the words: it reads these, too.
/// Small enough to copy: a copy is a bookmark from which to read on later.
class TextTokenizer {
 public:
  /// A newline can never start a comment, so as `comment` it means that there are none.
  static constexpr char kNoComments = '\n';

  /// `path` only labels the messages. `text` must outlive this object. `comment` starts a comment
  /// that ends with the line. The text begins on line `first_line` of its file.
  TextTokenizer(std::string path, std::string_view text, char comment = kNoComments, int first_line = 1);

  /// Whether only white space and comments are left.
  bool AtEnd();

  /// Whether only white space and a comment are left on the current line.
  bool AtLineEnd();

  /// The next word. All functions below throw as Fail() does if the file ends or does not fit.
  std::string_view NextWord();

  /// The next word as a number; `what` is for the message: "'abc' where `what` was expected".
  std::int64_t NextInteger(const char* what);

  /// The same for a number that must fit an int, such as a region tag.
  int NextInt(const char* what);

  /// The next word as a finite number.
  double NextReal(const char* what);

  /// The next word as the number of items that follow, each of `words_each` words or more. Counts
  /// that the rest of the file cannot hold are refused, so that the caller may allocate. `what`
  /// names the items, here and in the message of a file that ends among them.
  int NextCount(const char* what, int words_each);

  /// The same for a count that was read already, of items of `bytes_each` bytes or more.
  int CheckCount(std::int64_t count, const char* what, int bytes_each);

  void SkipWords(std::int64_t count);

  /// Moves to the next line and returns what was left on this one.
  std::string_view SkipLine();

  /// Moves to the next word that begins with a letter, or to the end.
  void SkipToLetter();

  /// Moves behind the next place where `text` stands, and returns whether there is one.
  bool SkipBeyond(std::string_view text);

  /// Moves to the next line, where bytes follow that are no text. From now on
  /// messages name the byte instead of the line.
  void BeginBinary();

  /// The next `count` items of `bytes_each` bytes, as they are.
  std::string_view NextBytes(std::int64_t count, int bytes_each, const char* what);

  /// Refuses NaN and infinity.
  void CheckFinite(double value, const char* what) const;

  /// The line of the last word that was read, from 1.
  int line() const { return word_line_; }

  /// Throws std::runtime_error "path:line: message".
  [[noreturn]] void Fail(const std::string& message) const;

 private:
  void SkipSpace();
  void FindWord();
  bool IsWordEnd(const char* position) const;
  template <typename Number>
  bool Parse(Number* value);

  std::string path_;
  const char* begin_;
  const char* next_;
  const char* end_;
  char comment_;
  bool is_binary_ = false;
  int line_;
  int word_line_;
  std::string expected_items_;
};

/// A word of the file for a message: in quotes, printable and not too long.
std::string Quoted(std::string_view word);

}  // namespace octupole::internal
