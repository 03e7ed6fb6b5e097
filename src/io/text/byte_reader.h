// Binary files taken apart value by value; their end is checked before every value.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace clench {

class ByteReader {
 public:
  /// `bytes` must outlive it
  explicit ByteReader(std::string_view bytes, bool big_endian = false)
      : bytes_(bytes), swap_(big_endian != (std::endian::native == std::endian::big)) {}

  size_t left() const { return bytes_.size() - at_; }
  size_t position() const { return at_; }
  void skip(size_t count) { at_ += count < left() ? count : left(); }
  /// The next value, an arithmetic type.   Call only while left() >= sizeof(T); else zero.
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

 private:
  std::string_view bytes_;
  bool swap_;
  size_t at_ = 0;
};

}  // namespace clench
