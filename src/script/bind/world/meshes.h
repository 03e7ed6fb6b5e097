// Surfaces of bodies.
#pragma once
#include "clench/geometry/tree/shape.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"

namespace clench {

// --- mesh: the surface of a body, immutable. ---

extern const Class mesh_class;

template <>
inline constexpr const Class* script_class<ShapePtr> = &mesh_class;

inline size_t owned_bytes(const ShapePtr& shape) {
  return shape.use_count() == 1 ? shape->bytes() : 0;
}

}  // namespace clench
