// Writes binary data value by value: the counterpart of ByteReader.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <type_traits>

namespace clench {

/// Appends the bytes of a number to `out`, least significant byte first.
template <class Number>
void append_little_endian(std::string& out, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  out.append(bytes.data(), bytes.size());
}

}  // namespace clench
