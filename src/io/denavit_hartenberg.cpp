#include "io/denavit_hartenberg.h"

#include <cmath>
#include <numbers>

namespace clench {

using Eigen::Vector3d;

// Axes that lean by less count as parallel: what the lean would move there is no more than what
// rounding makes of a common normal so far away. [rad]
static constexpr double parallel = 1e-8;
// axes nearer than this are one line [m]
static constexpr double coincident = 1e-13;

Pose dh_pose(double theta, double d, double a, double alpha) {
  return Pose::turn(theta, Vector3d::UnitZ()) * Pose::translation({a, 0, d}) *
         Pose::turn(alpha, Vector3d::UnitX());
}

/// An angle that counts both ways, brought within a quarter turn.   returns  was it turned round?
static bool to_quarter(double& angle) {
  constexpr double quarter = std::numbers::pi / 2;
  if (std::abs(angle) <= quarter + 1e-9) return false;
  angle += angle > 0 ? -2 * quarter : 2 * quarter;
  return true;
}

CommonNormal common_normal(const Pose& X_AB) {
  const Eigen::Matrix3d R = X_AB.matrix();
  const Vector3d z = R.col(2), p = X_AB.position;
  const double lean = std::hypot(z.x(), z.y());
  CommonNormal out;
  if (lean > parallel) {
    out.theta = std::atan2(z.x(), -z.y());
    out.alpha = std::atan2(to_quarter(out.theta) ? -lean : lean, z.z());
  } else {
    const double far = std::hypot(p.x(), p.y());
    if (far > coincident) out.theta = std::atan2(p.y(), p.x());
    to_quarter(out.theta);
    out.alpha = z.z() > 0 ? 0 : std::numbers::pi;
  }
  const double c = std::cos(out.theta), s = std::sin(out.theta);
  const Vector3d normal(c, s, 0), across(s, -c, 0);  // z = cos(alpha) z_A + sin(alpha) across
  out.a = p.dot(normal);
  if (std::abs(out.a) <= coincident) out.a = 0;
  if (lean > parallel) out.h = p.dot(across) / std::sin(out.alpha);
  out.d = p.z() - out.h * z.z();
  out.phi = std::atan2(R.col(0).dot(z.cross(normal)), R.col(0).dot(normal));
  return out;
}

DhChain denavit_hartenberg(const ChainSpec& chain, const Pose& X_BC) {
  const Pose none;
  DhChain out{X_BC, chain.joints, {}, 0};
  std::vector<Pose> after;  // what the file has for the frame after a joint, in ours
  Pose first = none;        // the chain's own frame in ours
  if (!chain.joints.empty() && !(chain.joints[0].X_before == none)) {
    out.X_BC = X_BC * chain.joints[0].X_before;
    first = chain.joints[0].X_before.inverse();
  }
  CommonNormal way;  // to the axis of this joint from where ours stands on it
  for (size_t j = 0; j < chain.joints.size(); ++j) {
    const JointSpec& joint = chain.joints[j];
    const bool last = j + 1 == chain.joints.size();
    const Pose before_next = last ? none : chain.joints[j + 1].X_before;
    const Pose own = dh_pose(0, 0, joint.a, joint.alpha) * joint.X_after;
    const double phi = way.phi, h = way.h;
    way = {};
    const bool kept = joint.X_after == none && before_next == none;
    if (kept)
      way.a = joint.a, way.alpha = joint.alpha;
    else if (!last)
      way = common_normal(own * before_next);
    JointSpec& ours = out.joints[j];
    ours.theta += phi + way.theta;
    ours.d += h + way.d;
    ours.a = way.a;
    ours.alpha = way.alpha;
    ours.placed_freely = false;
    ours.X_before = ours.X_after = none;
    after.push_back(kept ? none : dh_pose(way.theta, way.d, way.a, way.alpha).inverse() * own);
    out.farthest = std::max({out.farthest, std::abs(way.h), std::abs(way.d)});
  }
  for (const LinkSpec& link : chain.links) {
    const Pose& frame = link.last_joint < 0 ? first : after[link.last_joint];
    out.X_JL.push_back(!link.X_JL ? frame : frame == none ? *link.X_JL : frame * *link.X_JL);
  }
  return out;
}

}  // namespace clench
