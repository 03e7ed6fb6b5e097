// Typed handles of things that a World owns.
#pragma once
#include <compare>
#include <cstdint>

namespace clench {

/// An index and a generation; a stale one is detected, never dereferenced.
template <class T>
struct Id {
  uint32_t index = UINT32_MAX;
  uint32_t serial = 0;

  explicit operator bool() const { return index != UINT32_MAX; }
  auto operator<=>(const Id&) const = default;
};

}  // namespace clench
