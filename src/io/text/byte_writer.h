// Binary files put together value by value: the other side of ByteReader.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <type_traits>

namespace clench {

/// The bytes of a number, least one first, at the end of `out`.
template <class Number>
void append_little_endian(std::string& out, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
  out.append(bytes.data(), bytes.size());
}

}  // namespace clench
