// pose: a rigid transform.
#pragma once
#include "math/pose.h"
#include "script/object.h"

namespace clench {

extern const Class pose_class;
extern const Library pose_library;

template <>
inline const Class& class_of<Pose>() {
  return pose_class;
}

/// The pose that a table {xyz=, rpy= | quat= | matrix=} says.
/// throws  Error that begins with the subject
Pose pose_from_table(lua_State* L, int index, const std::string& subject);

}  // namespace clench
