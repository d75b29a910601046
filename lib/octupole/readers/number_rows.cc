#include "octupole/readers/internal/number_rows.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "octupole/readers/internal/text_tokenizer.h"

namespace octupole::internal {
namespace {

bool IsNumber(std::string_view word) {
  double value = 0;
  word.remove_prefix(word.front() == '+');
  return std::from_chars(word.data(), word.data() + word.size(), value).ec != std::errc::invalid_argument;
}

}  // namespace

void FailAtLine(const std::filesystem::path& path, int line, const std::string& message) {
  throw std::runtime_error(path.string() + ":" + std::to_string(line) + ": " + message);
}

void ForEachNumberRow(const std::filesystem::path& path,
                      const std::function<void(int line, const std::vector<double>& numbers)>& visit) {
  const FileContent content(path);
  std::string text(content.text());
  if (constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF"; text.compare(0, 3, kByteOrderMark) == 0) {
    text.erase(0, kByteOrderMark.size());
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  TextTokenizer tokens(path.string(), text, '#');
  std::vector<double> numbers;
  for (bool is_first = true; !tokens.AtEnd(); is_first = false) {
    TextTokenizer ahead = tokens;
    const std::string_view word = ahead.NextWord();
    if (is_first && !IsNumber(word)) {
      tokens.SkipLine();
      continue;
    }
    numbers.clear();
    while (!tokens.AtLineEnd()) numbers.push_back(tokens.NextReal("a number"));
    visit(tokens.line(), numbers);
  }
}

}  // namespace octupole::internal
