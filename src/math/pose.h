// Rigid transforms. X_AB is the pose of frame B in frame A: p_A = X_AB * p_B.
#pragma once
#include <Eigen/Geometry>

#include "clench/base/hash.h"

namespace clench {

/// wrench (force, torque) or twist (linear, angular)
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// v rotated by a unit quaternion; same bits as Eigen's product, inlined.
[[gnu::always_inline]] inline Eigen::Vector3d turned(const Eigen::Quaterniond& q,
                                                     const Eigen::Vector3d& v) {
  const double x = q.x(), y = q.y(), z = q.z(), w = q.w();
  double u0 = y * v.z() - z * v.y(), u1 = z * v.x() - x * v.z(), u2 = x * v.y() - y * v.x();
  u0 += u0, u1 += u1, u2 += u2;
  return {v.x() + w * u0 + (y * u2 - z * u1), v.y() + w * u1 + (z * u0 - x * u2),
          v.z() + w * u2 + (x * u1 - y * u0)};
}

/// Unit quaternion and position; stored as given, so that reading returns the same bits.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< unit
  Eigen::Vector3d position = Eigen::Vector3d::Zero();            ///< [m]

  static Pose translation(const Eigen::Vector3d& p) { return {Eigen::Quaterniond::Identity(), p}; }
  static Pose turn(const Eigen::Quaterniond& q) { return {q, Eigen::Vector3d::Zero()}; }
  /// a rotation by angle [rad] about a unit axis
  static Pose turn(double angle, const Eigen::Vector3d& axis) {
    return turn(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)));
  }

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const {
    return turned(rotation, p) + position;
  }
  Pose operator*(const Pose& other) const {
    return {(rotation * other.rotation).normalized(), *this * other.position};
  }
  Pose inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {back, -turned(back, position)};
  }
  Eigen::Matrix3d matrix() const { return rotation.toRotationMatrix(); }
  /// angle of the rotation, in [0, pi] [rad]; exact for small angles too
  double angle() const { return 2 * std::atan2(rotation.vec().norm(), std::abs(rotation.w())); }
  bool is_finite() const { return rotation.coeffs().allFinite() && position.allFinite(); }

  bool operator==(const Pose& other) const {
    return rotation.coeffs() == other.rotation.coeffs() && position == other.position;
  }
};

/// Interpolates linearly between positions and by the shortest rotation between orientations; t in
/// [0, 1].
inline Pose interpolate(const Pose& from, const Pose& to, double t) {
  return {from.rotation.slerp(t, to.rotation), from.position + t * (to.position - from.position)};
}

inline void add(Hasher& hasher, const Pose& pose) {
  for (const double x : pose.rotation.coeffs()) hasher.add(x);
  for (const double x : pose.position) hasher.add(x);
}

}  // namespace clench
