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

}  // namespace clench
