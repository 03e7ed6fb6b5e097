#include "clench/geometry/query/placement.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"

namespace clench {

using Eigen::Vector3d;

double rounding_of(const Bounds& bounds, const Vector3d& p) {
  const Vector3d reach =
      bounds.low.cwiseAbs().cwiseMax(bounds.high.cwiseAbs()).cwiseMax(p.cwiseAbs());
  return 256 * std::numeric_limits<double>::epsilon() * reach.maxCoeff();
}

double motion_bound(const Shape& b, const Pose& from, const Pose& to) {
  const Eigen::Matrix3d before = from.rotation.normalized().toRotationMatrix(),
                        after = to.rotation.normalized().toRotationMatrix();
  const Vector3d center = (after - before) * b.center() + (to.position - from.position);
  // a rotation by t moves points by 2 sin(t/2) times their distance from the center, and the norm
  // of the difference of the matrices is that times the square root of 2
  const double turn = (after - before).norm() * std::sqrt(0.5);
  return (center.norm() + turn * b.radius()) * (1 + 1e-12) +
         rounding_of(b.bounds(), from.position) + rounding_of(b.bounds(), to.position);
}

Pose checked_pose(const Pose& X_AB) {
  const Eigen::Quaterniond& q = X_AB.rotation;
  const double norm = q.norm();
  if (!(std::abs(norm - 1) < 0.1))
    fail("geometry query: pose: expected a unit quaternion, got ({}, {}, {}, {})", q.w(), q.x(),
         q.y(), q.z());
  // beyond this, products of lengths exceed the range of doubles [m]
  constexpr double largest_offset = 1e30;
  const Vector3d& p = X_AB.position;
  if (!p.allFinite() || p.cwiseAbs().maxCoeff() > largest_offset)
    fail("geometry query: position of the pose must be finite and within {} [m], got ({}, {}, {})",
         largest_offset, p.x(), p.y(), p.z());
  return {Eigen::Quaterniond(q.coeffs() / norm), p};
}

Placement::Placement(const Shape& a, const Shape& b, const Pose& X_AB)
    : mesh_a_(a.mesh()),
      mesh_b_(b.mesh()),
      rotation_(checked_pose(X_AB).matrix()),
      position_(X_AB.position),
      trees_{&a.tree(), &b.tree(), {}, {}, 0} {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(trees_.rotation) = rotation_;
  Vector3d::Map(trees_.offset) =
      to_a(Vector3d::Map(b.tree().center())) - Vector3d::Map(a.tree().center());
  trees_.rounding = rounding_of(a.bounds(), position_) + rounding_of(b.bounds(), position_);
}

bool Placement::clearly_apart(double reach, PairCache* cache) const {
  const Vector3d start = cache ? cache->separation : Vector3d::Zero();
  const Separation found = find_separation(trees_, std::max(reach, 0.0), start.data());
  if (found.found && cache) cache->separation = Vector3d::Map(found.along);
  return found.found;
}

}  // namespace clench
