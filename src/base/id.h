// Names for things that a World owns.
#pragma once
#include <compare>
#include <cstdint>

namespace clench {

/// A place and the serial number of what was put there; a stale one is found out, never followed.
template <class T>
struct Id {
  uint32_t index = UINT32_MAX;
  uint32_t serial = 0;

  explicit operator bool() const { return index != UINT32_MAX; }
  auto operator<=>(const Id&) const = default;
};

}  // namespace clench
