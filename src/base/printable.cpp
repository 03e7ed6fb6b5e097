#include "clench/base/printable.h"

#include <algorithm>

namespace clench {

size_t control_size(std::string_view text, size_t i) {
  const auto byte = [&](size_t k) {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
  };
  if (byte(0) < ' ' || byte(0) == 127) return 1;
  // U+0080 to U+009F
  if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) return 2;
  // U+2028 to U+202E, U+2066 to U+2069
  const bool separates = byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE,
             isolates = byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9;
  return byte(0) == 0xE2 && (separates || isolates) ? 3 : 0;
}

char* make_printable(char* begin, char* end) {
  const std::string_view text(begin, static_cast<size_t>(end - begin));
  char* out = begin;
  for (size_t i = 0; i < text.size();) {
    const size_t size = control_size(text, i);
    *out++ = size == 0 ? text[i] : '?';
    i += std::max<size_t>(size, 1);
  }
  return out;
}

std::string printable(std::string_view text, std::string_view kept) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    const size_t size = control_size(text, i);
    out += size == 0 || kept.find(text[i]) != kept.npos ? text[i] : '?';
    i += std::max<size_t>(size, 1);
  }
  return out;
}

}  // namespace clench
