#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace octupole::internal {

/// The whole content of a file.
///
/// \throw std::runtime_error with the operating system's reason if it cannot be read.
std::string ReadTextFile(const std::filesystem::path& path);

/// Cuts a text into words at white space and reads numbers from them, in the C locale whatever the
/// process has set. Small enough to copy: a copy is a bookmark from which to read on later.
class TextTokenizer {
 public:
  /// A newline can never start a comment, so as `comment` it means that there are none.
  static constexpr char kNoComments = '\n';

  /// `path` only labels the messages. `text` must outlive this object. `comment` starts a comment
  /// that ends with the line.
  TextTokenizer(std::string path, std::string_view text, char comment = kNoComments);

  /// Whether only white space and comments are left.
  bool AtEnd();

  /// Whether only white space is left on the current line.
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

  void SkipWords(std::int64_t count);

  /// Moves to the end of the current line and returns what was left on it.
  std::string_view SkipLine();

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
  const char* next_;
  const char* end_;
  char comment_;
  int line_ = 1;
  int word_line_ = 1;
  std::string expected_items_;
};

/// A word of the file for a message: in quotes, printable and not too long.
std::string Quoted(std::string_view word);

}  // namespace octupole::internal
