#include "clench/spec/valid.h"

#include <cmath>

#include "clench/base/printable.h"
#include "clench/base/text.h"

namespace clench {

std::string fault(const Quantity& quantity, double x) {
  if (quantity.allows(x)) return "";
  const std::string unit = *quantity.unit ? fmt::format(" [{}]", quantity.unit) : "";
  // singular or plural as required
  return fmt::format("expected a number from {:g} to {:g}{}, got {}", quantity.min, quantity.max,
                     unit, std::isnan(x) ? std::abs(x) : x);
}

void check(const Quantity& quantity, double x, std::string_view subject) {
  if (!quantity.allows(x)) fail("{}: {}: {}", subject, quantity.name, fault(quantity, x));
}

void check(const Quantity& quantity, const Eigen::Vector3d& v, std::string_view subject) {
  for (const double x : v) check(quantity, x, subject);
}

void check_each(const Quantity& quantity, std::initializer_list<NamedNumber> numbers,
                std::string_view subject) {
  for (const auto& [name, value] : numbers) check(quantity.called(name), value, subject);
}

bool is_place(const Pose& X) {
  // files have six digits; values read are normalized, so this is rounding
  return (X.position.array().abs() <= largest_coordinate).all() &&
         std::abs(X.rotation.norm() - 1) <= 1e-6;
}

void check_place(const Pose& X, std::string_view subject) {
  if (is_place(X)) return;
  const Eigen::Vector3d& p = X.position;
  if (!(p.array().abs() <= largest_coordinate).all())
    fail("{}: expected a position within {:g} m of the origin, got ({}, {}, {})", subject,
         largest_coordinate, p.x(), p.y(), p.z());
  fail("{}: expected a unit quaternion, got one of length {}", subject, X.rotation.norm());
}

/// Bytes of the character at i if a name may contain it; 0: it may not.
static size_t name_character(std::string_view text, size_t i) {
  const size_t size = utf8_size(text, i);
  return control_size(text, i) ? 0 : size;
}

std::string name_fault(std::string_view name) {
  if (name.size() > max_name_length)
    return fmt::format("expected at most {} bytes, got {}", max_name_length, name.size());
  for (size_t i = 0; i < name.size();) {
    const size_t size = name_character(name, i);
    if (size == 0)
      return fmt::format("expected {}, got {}",
                         utf8_size(name, i) ? "no control characters" : "text in UTF-8",
                         in_quotes(name));
    i += size;
  }
  return "";
}

void check_name(std::string_view name, std::string_view subject) {
  if (const auto fault = name_fault(name); !fault.empty()) fail("{}: name: {}", subject, fault);
}

/// Bytes at i that are replaced by one '?': a control character, or a sequence that is not UTF-8.
static size_t bad_length(std::string_view text, size_t i) {
  if (const size_t control = control_size(text, i)) return control;
  constexpr auto is_tail = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  const auto first = static_cast<unsigned char>(text[i]);
  const size_t longest = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 1;
  size_t length = 1;
  while (length < longest && i + length < text.size() && is_tail(text[i + length])) ++length;
  return length;
}

std::string repaired_name(std::string_view name) {
  std::string out;
  for (size_t i = 0; i < name.size();) {
    const size_t size = name_character(name, i);
    if (out.size() + std::max<size_t>(size, 1) > max_name_length) break;
    size ? out += name.substr(i, size) : out += '?';
    i += size ? size : bad_length(name, i);
  }
  return out;
}

}  // namespace clench
