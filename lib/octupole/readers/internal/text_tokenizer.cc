#include "octupole/readers/internal/text_tokenizer.h"

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
  word.remove_prefix(word.front() == '+');
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc::result_out_of_range && stop == word.data() + word.size() &&
         (word.find("e-") != word.npos || word.find("E-") != word.npos);
}

}  // namespace

FileContent::FileContent(const std::filesystem::path& path) {
  // The size fails with a good reason for what is missing, a directory or a device.
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error) {
    throw std::runtime_error(path.string() + ": cannot be read: " + error.message());
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (file) {
    bytes_.reset(new char[size_]);
    file.read(bytes_.get(), static_cast<std::streamsize>(size_));
  }
  if (!file) {
    throw std::runtime_error(path.string() + ": cannot be read: " + std::generic_category().message(errno));
  }
}

TextTokenizer::TextTokenizer(std::string path, std::string_view text, char comment, int first_line)
    : path_(std::move(path)),
      begin_(text.data()),
      next_(text.data()),
      end_(text.data() + text.size()),
      comment_(comment),
      line_(first_line),
      word_line_(first_line) {}

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
  return next_ == end_ || *next_ == '\n' || *next_ == comment_;
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
  const char* begin = *next_ == '+' && next_ + 1 != end_ && next_[1] != '-' ? next_ + 1 : next_;
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
  CheckFinite(value, what);
  return value;
}

void TextTokenizer::CheckFinite(double value, const char* what) const {
  if (!std::isfinite(value)) {
    Fail(std::to_string(value) + " where a finite number was expected for " + what);
  }
}

int TextTokenizer::NextCount(const char* what, int words_each) {
  const std::int64_t count = NextInteger((std::string("the number of ") + what).c_str());
  return CheckCount(count, what, 2 * words_each);  // a word takes two bytes at least, with the white space before it
}

int TextTokenizer::CheckCount(std::int64_t count, const char* what, int bytes_each) {
  if (count < 0) {
    Fail(std::to_string(count) + " as the number of " + what);
  }
  const std::int64_t bytes = end_ - next_;
  // A first word may lack the white space, so there may be one byte less.
  if (count > (bytes + 1) / bytes_each || count > std::numeric_limits<int>::max()) {
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
  const char* end = std::find(next_, end_, '\n');
  next_ = end;
  if (next_ != end_) {
    ++next_;
    ++line_;
  }
  return {begin, static_cast<std::size_t>(end - begin)};
}

void TextTokenizer::SkipToLetter() {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  while (!AtEnd() && !is_letter(*next_)) {
    NextWord();
  }
}

bool TextTokenizer::SkipBeyond(std::string_view text) {
  const std::size_t position = std::string_view(next_, static_cast<std::size_t>(end_ - next_)).find(text);
  if (position == std::string_view::npos) {
    return false;
  }
  line_ += static_cast<int>(std::count(next_, next_ + position, '\n'));
  next_ += position + text.size();
  return true;
}

void TextTokenizer::BeginBinary() {
  SkipLine();
  is_binary_ = true;
}

std::string_view TextTokenizer::NextBytes(std::int64_t count, int bytes_each, const char* what) {
  if (count < 0 || count > (end_ - next_) / bytes_each) {
    Fail("the file ends before " + std::string(what));
  }
  const std::string_view bytes(next_, static_cast<std::size_t>(count * bytes_each));
  next_ += bytes.size();
  return bytes;
}

void TextTokenizer::Fail(const std::string& message) const {
  throw std::runtime_error(path_ +
                           (is_binary_ ? ":byte " + std::to_string(next_ - begin_) : ":" + std::to_string(word_line_)) +
                           ": " + message);
}

std::string Quoted(std::string_view word) {
  constexpr std::size_t kMaxLength = 32;
  std::string text(word.substr(0, kMaxLength));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (word.size() > kMaxLength ? "...'" : "'");
}

}  // namespace octupole::internal
