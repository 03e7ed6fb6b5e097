// Values that are read and pushed everywhere: vectors and poses.
#pragma once
#include <Eigen/Core>

#include "clench/math/pose.h"
#include "clench/script/lua/object.h"

namespace clench {

extern const Class vec3_class, pose_class;

template <>
inline constexpr const Class* script_class<Eigen::Vector3d> = &vec3_class;
template <>
inline constexpr const Class* script_class<Pose> = &pose_class;

/// "(0.1, 0, -2)", six digits
std::string vec3_text(const Eigen::Vector3d& v);

/// The pose of a table {xyz=, rpy= | quat= | matrix=}.
/// throws  Error that begins with the subject
Pose pose_from_table(lua_State* L, int index, const std::string& subject);

}  // namespace clench
