#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace octupole::internal {

/// Whether this machine stores the lowest byte of a number first.
inline bool IsLittleEndian() {
  const std::uint16_t one = 1;
  std::uint8_t first_byte;
  std::memcpy(&first_byte, &one, 1);
  return first_byte == 1;
}

/// The number stored at `bytes`, in the other byte order if `swap`.
template <typename Number>
Number FromBytes(const char* bytes, bool swap) {
  std::array<char, sizeof(Number)> copy;
  std::memcpy(copy.data(), bytes, sizeof(Number));
  if (swap) {
    std::reverse(copy.begin(), copy.end());
  }
  Number number;
  std::memcpy(&number, copy.data(), sizeof(Number));
  return number;
}

/// The types of numbers in binary arrays.
enum class NumberType { kInt8, kUInt8, kInt16, kUInt16, kInt32, kUInt32, kInt64, kUInt64, kFloat32, kFloat64 };

inline bool IsInteger(NumberType type) { return type != NumberType::kFloat32 && type != NumberType::kFloat64; }

/// Calls visit(a number of this type).
template <typename Visit>
auto VisitType(NumberType type, const Visit& visit) {
  switch (type) {
    case NumberType::kInt8:  // NOLINT(bugprone-branch-clone): they differ in their types
      return visit(std::int8_t());
    case NumberType::kUInt8:
      return visit(std::uint8_t());
    case NumberType::kInt16:
      return visit(std::int16_t());
    case NumberType::kUInt16:
      return visit(std::uint16_t());
    case NumberType::kInt32:
      return visit(std::int32_t());
    case NumberType::kUInt32:
      return visit(std::uint32_t());
    case NumberType::kInt64:
      return visit(std::int64_t());
    case NumberType::kUInt64:
      return visit(std::uint64_t());
    case NumberType::kFloat32:
      return visit(float());
    case NumberType::kFloat64:
      break;
  }
  return visit(double());
}

inline int SizeOf(NumberType type) {
  return VisitType(type, [](auto number) { return static_cast<int>(sizeof(number)); });
}

/// Calls take(number) for each number of an array of bytes.
template <typename Take>
void ForEachNumber(std::string_view bytes, NumberType type, bool swap, const Take& take) {
  VisitType(type, [&](auto zero) {
    for (std::size_t i = 0; i + sizeof(zero) <= bytes.size(); i += sizeof(zero)) {
      take(FromBytes<decltype(zero)>(bytes.data() + i, swap));
    }
  });
}

}  // namespace octupole::internal
