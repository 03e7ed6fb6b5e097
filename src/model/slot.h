// Entries of bodies and robots, found by their ids.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "clench/base/error.h"
#include "clench/base/id.h"
#include "clench/base/text.h"

namespace clench {

/// An entry for a T, with the serial number of its present or last occupant.
template <class T>
struct Slot {
  uint32_t serial = 0;
  bool used = false;
  T value;  ///< of the last occupant; its name is kept for errors
};

template <class T>
bool holds(const std::vector<Slot<T>>& slots, Id<T> id) {
  return id.index < slots.size() && slots[id.index].used && slots[id.index].serial == id.serial;
}

/// The object of an id.
/// what    "body", for the message
/// throws  Error if the id is stale, which names the object if possible
template <class T>
const T& follow(const std::vector<Slot<T>>& slots, Id<T> id, const char* what) {
  if (holds(slots, id)) return slots[id.index].value;
  if (id.index < slots.size() && slots[id.index].serial == id.serial)
    fail(ErrorKind::stale, "{} '{}' was removed from its world", what,
         excerpt(slots[id.index].value.name));
  fail(ErrorKind::stale, "this {} is no longer in its world", what);
}

template <class T>
Id<T> insert_slot(std::vector<Slot<T>>& slots, T value, uint32_t serial) {
  slots.push_back({serial, true, std::move(value)});
  return {static_cast<uint32_t>(slots.size() - 1), serial};
}

}  // namespace clench
