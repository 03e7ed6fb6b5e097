// grasps: lists of them, from files and to files.
#pragma once
#include <vector>

#include "script/bind_grasp.h"

namespace clench {

struct GraspList {
  std::vector<GraspHandle> grasps;
};

extern const Class grasps_class;
extern const Library grasps_library;

template <>
inline const Class& class_of<GraspList>() {
  return grasps_class;
}

}  // namespace clench
