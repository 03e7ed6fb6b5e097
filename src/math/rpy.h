// Roll, pitch and yaw of a rotation.
#pragma once
#include <Eigen/Core>
#include <cmath>

namespace clench {

/// Angles about the fixed axes x, then y, then z [rad]: R = Rz(yaw) Ry(pitch) Rx(roll). If the
/// pitch is a quarter turn, roll is 0. Roll and pitch are computed after undoing the yaw, so that
/// the three are consistent near that singularity, too.
inline Eigen::Vector3d rpy_of(const Eigen::Matrix3d& R) {
  const bool quarter = std::hypot(R(0, 0), R(1, 0)) < 1e-12;
  const double yaw = quarter ? std::atan2(-R(0, 1), R(1, 1)) : std::atan2(R(1, 0), R(0, 0));
  const double c = std::cos(yaw), s = std::sin(yaw);
  const double roll =
      quarter ? 0 : std::atan2(s * R(0, 2) - c * R(1, 2), c * R(1, 1) - s * R(0, 1));
  return {roll, std::atan2(-R(2, 0), c * R(0, 0) + s * R(1, 0)), yaw};
}

}  // namespace clench
