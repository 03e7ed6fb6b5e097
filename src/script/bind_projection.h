// projection: a wrench space in three coordinates.
#pragma once
#include "grasp/projection.h"
#include "script/bind_wrench_space.h"

namespace clench {

struct ProjectionHandle {
  std::shared_ptr<const Projection> projection;
  ShapePtr shape;  ///< null when it is flat
  WrenchSpacePtr space;
};

/// of a wrench space: leaves its projection on the stack
int project_space(lua_State* L);

extern const Class projection_class;

template <>
inline const Class& class_of<ProjectionHandle>() {
  return projection_class;
}

inline size_t owned_bytes(const ProjectionHandle& handle) {
  // its mesh lies in both
  return sizeof(Projection) + (handle.shape ? 2 * handle.shape->bytes() : 0);
}

}  // namespace clench
