#include "octupole/view/internal/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace octupole::internal {
namespace {

TEST(JsonString, ReadsBackAndClosesNoScript) {
  for (const std::string text :
       {"", "plain", "\"quoted\" \\ back", "</script><!--", "line\nand\ttab\x01\x7f", "\xc3\xa9"}) {
    EXPECT_EQ(nlohmann::json::parse(JsonString(text)).get<std::string>(), text);
    EXPECT_EQ(JsonString(text).find('<'), std::string::npos);
  }
}

TEST(JsonNumber, ReadsBack) {
  for (const double number : {0., -1.5, 0.1, 1e-300, 1e300, 123456789.}) {
    EXPECT_EQ(nlohmann::json::parse(JsonNumber(number)).get<double>(), number);
  }
}

TEST(JsonBytes, IsBase64) {  // the examples of RFC 4648, section 10
  const auto encoded = [](const std::string& text) { return JsonBytes({text.begin(), text.end()}); };
  EXPECT_EQ(encoded(""), "\"\"");
  EXPECT_EQ(encoded("f"), "\"Zg==\"");
  EXPECT_EQ(encoded("fo"), "\"Zm8=\"");
  EXPECT_EQ(encoded("foobar"), "\"Zm9vYmFy\"");
  EXPECT_EQ(encoded("\xff\xff\xfe"), "\"///+\"");
}

}  // namespace
}  // namespace octupole::internal
