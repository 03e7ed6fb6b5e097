// grasp and wrench_space.
#pragma once
#include "grasp/grasp.h"
#include "script/handles.h"

namespace clench {

/// A grasp as it was measured, and its wrench space once somebody has asked for it.
struct GraspHandle {
  WorldPtr world;
  Grasp grasp;
  std::shared_ptr<const WrenchSpace> space;
};

using WrenchSpacePtr = std::shared_ptr<const WrenchSpace>;

extern const Class grasp_class, wrench_space_class;
extern const Library grasp_library;

template <>
inline const Class& class_of<GraspHandle>() {
  return grasp_class;
}
template <>
inline const Class& class_of<WrenchSpacePtr>() {
  return wrench_space_class;
}

}  // namespace clench
