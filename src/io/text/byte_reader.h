// Reads binary data value by value; each read checks that enough bytes are left.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace clench {

/// Binary representation of a number.
enum class NumberType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline size_t bytes_of(NumberType type) {
  constexpr size_t bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<int>(type)];
}

class ByteReader {
 public:
  /// `bytes` must outlive it
  explicit ByteReader(std::string_view bytes, bool big_endian = false)
      : bytes_(bytes), swap_(big_endian != (std::endian::native == std::endian::big)) {}

  size_t left() const { return bytes_.size() - at_; }
  size_t position() const { return at_; }
  void skip(size_t count) { at_ += count < left() ? count : left(); }
  /// The next value, an arithmetic type.   Call only while left() >= sizeof(T); otherwise zero.
  template <class T>
  T next() {
    if (left() < sizeof(T)) {
      at_ = bytes_.size();
      return {};
    }
    unsigned char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swap_)
      for (size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(raw[i], raw[sizeof(T) - 1 - i]);
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  double next(NumberType type) {
    switch (type) {
      case NumberType::int8:
        return next<int8_t>();
      case NumberType::uint8:
        return next<uint8_t>();
      case NumberType::int16:
        return next<int16_t>();
      case NumberType::uint16:
        return next<uint16_t>();
      case NumberType::int32:
        return next<int32_t>();
      case NumberType::uint32:
        return next<uint32_t>();
      case NumberType::float32:
        return next<float>();
      case NumberType::float64:
        return next<double>();
    }
    return 0;
  }

 private:
  std::string_view bytes_;
  bool swap_;
  size_t at_ = 0;
};

}  // namespace clench
