#include "clench/dynamics/contact/rolling.h"

#include <algorithm>
#include <cmath>

#include "clench/geometry/round/round.h"

namespace clench {

using Eigen::Vector3d;

// The point farthest along a unit direction of what rolls at p: the ball at the end of a capsule
// or along it, the circle of a cylinder at that height, or all of an ellipsoid.
static Vector3d farthest_at(const Round& solid, const Vector3d& p, const Vector3d& direction) {
  if (solid.kind == Round::ellipsoid) return support(solid, direction);
  const Vector3d middle(0, 0, std::clamp(p.z(), -solid.half, solid.half));
  if (solid.kind == Round::capsule) return middle + solid.radii.x() * direction;
  const Vector3d aside(direction.x(), direction.y(), 0);
  return middle + solid.radii.x() * aside.stableNormalized();
}

// How much farther a body reaches along n after h than its material point at p does [m].
// n, p  in the frame of the body; spin: angular velocity there
static double farther_reach(const Round& solid, const Pose& X_BR, const Vector3d& com,
                            const Vector3d& p, const Vector3d& n, const Vector3d& spin, double h) {
  const Vector3d turn = h * spin;
  const double angle = turn.norm();
  if (angle == 0) return 0;
  // the body turns by `turn`: the direction turns back in its frame
  const Vector3d later = Eigen::AngleAxisd(-angle, turn / angle) * n;
  const Pose into = X_BR.inverse();
  const Vector3d p_R = into * p;
  const auto reach = [&](const Vector3d& direction) {
    const Vector3d d_R = into.rotation * direction;
    return d_R.dot(farthest_at(solid, p_R, d_R)) + direction.dot(X_BR.position - com);
  };
  return reach(later) - reach(n) - h * n.dot(spin.cross(p - com));
}

double rolled_gap(const World& world, const Manifold& m, const ManifoldPoint& point, double h) {
  if (!world.dynamics()) return 0;
  double change = 0;
  for (const bool is_b : {false, true}) {
    const Feature& feature = is_b ? point.feature_b : point.feature_a;
    if (feature.kind != Feature::round) continue;
    const Id<Body> id = is_b ? m.b : m.a;
    const Body& body = world.body(id);
    const RoundPiece& piece = body.shape->rounds().pieces[feature.first];
    const Eigen::Quaterniond back = world.pose(id).rotation.conjugate();
    const Vector3d n_W = world.pose(m.a).rotation * point.normal;
    const Vector3d n = back * Vector3d(is_b ? -n_W : n_W);
    const Vector3d n_R = piece.X_SR.rotation.conjugate() * n;
    // a cylinder on its cap stands on points of its rim
    if (flat_part(piece.solid, n_R, world.contact_threshold()).kind == FlatPart::disc) continue;
    const Vector3d spin = back * world.dynamics()->twists[id.index].angular;
    change -=
        farther_reach(piece.solid, piece.X_SR, body.com, is_b ? point.p_b : point.p_a, n, spin, h);
  }
  return change;
}

}  // namespace clench
