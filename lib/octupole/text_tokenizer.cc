#include "octupole/text_tokenizer.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace octupole::internal {
namespace {

bool IsSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Whether a word is a number between zero and the smallest double, which from_chars refuses just
/// as one beyond the largest.
bool IsCloseToZero(std::string_view word) {
  double value = 0.0;
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc::result_out_of_range && stop == word.data() + word.size() &&
         (word.find("e-") != word.npos || word.find("E-") != word.npos);
}

}  // namespace

std::string ReadTextFile(const std::filesystem::path& path) {
  // The size fails with a good reason for what is missing, a directory or a device.
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) {
    throw std::runtime_error(path.string() + ": cannot be read: " + error.message());
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  if (file) {
    text.resize(size);
    file.read(text.data(), static_cast<std::streamsize>(size));
  }
  if (!file) {
    throw std::runtime_error(path.string() + ": cannot be read: " + std::generic_category().message(errno));
  }
  return text;
}

TextTokenizer::TextTokenizer(std::string path, std::string_view text, char comment)
    : path_(std::move(path)), next_(text.data()), end_(text.data() + text.size()), comment_(comment) {}

void TextTokenizer::SkipSpace() {
  while (next_ != end_) {
    if (*next_ == '\n') {
      ++line_;
    } else if (*next_ == comment_) {
      next_ = std::find(next_, end_, '\n');
      continue;
    } else if (!IsSpace(*next_)) {
      return;
    }
    ++next_;
  }
}

bool TextTokenizer::AtEnd() {
  SkipSpace();
  return next_ == end_;
}

bool TextTokenizer::AtLineEnd() {
  while (next_ != end_ && *next_ != '\n' && IsSpace(*next_)) {
    ++next_;
  }
  return next_ == end_ || *next_ == '\n';
}

void TextTokenizer::FindWord() {
  if (AtEnd()) {
    Fail(expected_items_.empty() ? "the file ends too early"
                                 : "the file ends before all " + expected_items_ + " are read");
  }
  word_line_ = line_;
}

bool TextTokenizer::IsWordEnd(const char* position) const {
  return position == end_ || IsSpace(*position) || *position == comment_;
}

std::string_view TextTokenizer::NextWord() {
  FindWord();
  const char* begin = next_;
  while (!IsWordEnd(next_)) {
    ++next_;
  }
  return {begin, static_cast<std::size_t>(next_ - begin)};
}

template <typename Number>
bool TextTokenizer::Parse(Number* value) {
  FindWord();
  // from_chars does not know the plus sign that Fortran programs write.
  const char* begin = *next_ == '+' ? next_ + 1 : next_;
  const auto [stop, error] = std::from_chars(begin, end_, *value);
  if (error != std::errc() || !IsWordEnd(stop)) {
    return false;
  }
  next_ = stop;
  return true;
}

std::int64_t TextTokenizer::NextInteger(const char* what) {
  std::int64_t value = 0;
  if (!Parse(&value)) {
    Fail(Quoted(NextWord()) + " where " + what + " was expected");
  }
  return value;
}

int TextTokenizer::NextInt(const char* what) {
  const std::int64_t value = NextInteger(what);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max()) {
    Fail(std::to_string(value) + " is too large for " + what);
  }
  return static_cast<int>(value);
}

double TextTokenizer::NextReal(const char* what) {
  double value = 0;
  if (!Parse(&value)) {
    const std::string_view word = NextWord();
    if (IsCloseToZero(word)) {
      return 0.0;
    }
    Fail(Quoted(word) + " where " + what + " was expected");
  }
  if (!std::isfinite(value)) {
    Fail(std::to_string(value) + " where a finite number was expected for " + what);
  }
  return value;
}

int TextTokenizer::NextCount(const char* what, int words_each) {
  const std::int64_t count = NextInteger((std::string("the number of ") + what).c_str());
  if (count < 0) {
    Fail(std::to_string(count) + " as the number of " + what);
  }
  // Every word takes two bytes at least, with the white space before it.
  const std::int64_t bytes = end_ - next_;
  if (count > bytes / 2 / words_each || count > std::numeric_limits<int>::max()) {
    Fail(std::to_string(count) + " " + what + " announced, but only " + std::to_string(bytes) + " bytes follow");
  }
  expected_items_ = std::to_string(count) + " " + what;
  return static_cast<int>(count);
}

void TextTokenizer::SkipWords(std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) {
    NextWord();
  }
}

std::string_view TextTokenizer::SkipLine() {
  const char* begin = next_;
  next_ = std::find(next_, end_, '\n');
  return {begin, static_cast<std::size_t>(next_ - begin)};
}

void TextTokenizer::Fail(const std::string& message) const {
  throw std::runtime_error(path_ + ":" + std::to_string(word_line_) + ": " + message);
}

std::string Quoted(std::string_view word) {
  constexpr std::size_t kMaxLength = 32;
  std::string text(word.substr(0, kMaxLength));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (word.size() > kMaxLength ? "...'" : "'");
}

}  // namespace octupole::internal
