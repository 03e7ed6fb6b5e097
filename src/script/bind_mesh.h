// mesh: the surface of a body, immutable.
#pragma once
#include "geometry/shape.h"
#include "script/object.h"

namespace clench {

extern const Class mesh_class;

template <>
inline const Class& class_of<ShapePtr>() {
  return mesh_class;
}

inline size_t owned_bytes(const ShapePtr& shape) {
  return shape.use_count() == 1 ? shape->bytes() : 0;
}

}  // namespace clench
