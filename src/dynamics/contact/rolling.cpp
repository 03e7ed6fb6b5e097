#include "clench/dynamics/contact/rolling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "clench/geometry/round/round.h"

namespace clench {

using Eigen::Vector3d;

// Farthest point along a unit direction of the part that rolls at p: the ball at the end of a
// capsule or along it, the circle of a cylinder at that height, or the complete ellipsoid.
static Vector3d farthest_at(const Round& solid, const Vector3d& p, const Vector3d& direction) {
  if (solid.kind == Round::ellipsoid) return support(solid, direction);
  const Vector3d middle(0, 0, std::clamp(p.z(), -solid.half, solid.half));
  if (solid.kind == Round::capsule) return middle + solid.radii.x() * direction;
  const Vector3d aside(direction.x(), direction.y(), 0);
  return middle + solid.radii.x() * aside.stableNormalized();
}

static Eigen::Quaterniond turned_in(const Vector3d& spin, double h) {
  const double angle = h * spin.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, spin.normalized()));
}

namespace {

// One of the two bodies at a contact point, in world axes relative to its com.
struct TouchingSide {
  TouchingSide(const World& world, const Manifold& m, const ManifoldPoint& point, bool is_b,
               const Vector3d& outward, double h)
      : body(world.body(is_b ? m.b : m.a)),
        turn(world.pose(is_b ? m.b : m.a).rotation),
        twist(world.dynamics()->twists[(is_b ? m.b : m.a).index]),
        later(turned_in(twist.angular, h) * turn),
        p(is_b ? point.p_b : point.p_a) {
    const Feature& feature = is_b ? point.feature_b : point.feature_a;
    is_face = feature.kind == Feature::triangle;
    if (feature.kind != Feature::round) return;
    piece = &body.shape->rounds().pieces[feature.first];
    const Vector3d n_R = piece->X_SR.rotation.conjugate() * (turn.conjugate() * outward);
    // a cylinder on its cap stands on points of its rim
    is_face = flat_part(piece->solid, n_R, world.contact_threshold()).kind == FlatPart::disc;
    if (is_face) piece = nullptr;
  }

  // Extent of the body along n from its com, in the orientation R [m].
  double reach(const Eigen::Quaterniond& R, const Vector3d& n) const {
    const Vector3d n_B = R.conjugate() * n;
    if (!piece) return n_B.dot(p - body.com);
    const Vector3d n_R = piece->X_SR.rotation.conjugate() * n_B;
    const Vector3d farthest = farthest_at(piece->solid, piece->X_SR.inverse() * p, n_R);
    return n_R.dot(farthest) + n_B.dot(piece->X_SR.position - body.com);
  }
  Vector3d arm() const { return turn * (p - body.com); }

  const Body& body;
  Eigen::Quaterniond turn;  // velocity of the body in the world
  const Twist& twist;
  Eigen::Quaterniond later;           // rotation after h
  Vector3d p;                         // the point, in the frame of the body
  const RoundPiece* piece = nullptr;  // the part that rolls there; null: p is fixed on the body
  bool is_face = false;               // does the direction of the contact rotate with the body?
};

}  // namespace

double rolled_gap(const World& world, const Manifold& m, const ManifoldPoint& point, double h) {
  if (!world.dynamics()) return 0;
  if (point.feature_a.kind != Feature::round && point.feature_b.kind != Feature::round) return 0;
  const std::vector<Twist>& twists = world.dynamics()->twists;
  if (twists[m.a.index].angular.isZero(0) && twists[m.b.index].angular.isZero(0)) return 0;
  const Vector3d n = world.pose(m.a).rotation * point.normal;
  const TouchingSide a(world, m, point, false, n, h), b(world, m, point, true, -n, h);
  if (!a.piece && !b.piece) return 0;
  Vector3d later = n;
  if (a.is_face)
    later = a.later * (a.turn.conjugate() * n);
  else if (b.is_face)
    later = b.later * (b.turn.conjugate() * n);
  // velocity of b's com relative to a's, as far as the direction rotates; the velocities along n
  // are not due to rolling
  const Vector3d apart = a.arm() + point.gap * n - b.arm();
  double change = (later - n).dot(apart + h * (b.twist.linear - a.twist.linear));
  for (const TouchingSide* side : {&a, &b}) {
    const double sign = side == &a ? 1 : -1;
    change -= side->reach(side->later, sign * later) - side->reach(side->turn, sign * n) -
              h * sign * n.dot(side->twist.angular.cross(side->arm()));
  }
  return change;
}

}  // namespace clench
