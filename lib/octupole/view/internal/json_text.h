#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace octupole::internal {

/// A string of JSON, quotes included, that is harmless inside an HTML script element: no `<` is left in it.
std::string JsonString(std::string_view text);

/// A finite number, with the fewest digits that read back as it.
std::string JsonNumber(double number);

/// Bytes as a string of JSON in base64, the integers of an array little end first.
std::string JsonBytes(const std::vector<unsigned char>& bytes);

}  // namespace octupole::internal
