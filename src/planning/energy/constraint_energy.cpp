#include "clench/planning/energy/constraint_energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/model/find.h"

namespace clench {

using Eigen::Vector3d;

static Pose approach_pose(const World& world, Id<Robot> hand) {
  const Robot& robot = world.robot(hand);
  return world.pose(robot.base) * robot.X_BA;
}

// --- ApproachCone ---

ApproachCone::ApproachCone(Id<Robot> hand, const Vector3d& axis, double max_angle)
    : hand_(hand), axis_(axis.stableNormalized()), max_angle_(max_angle) {
  if (!axis.allFinite() || axis.isZero(0)) fail("energy: axis: expected a direction");
  if (!(max_angle >= 0 && max_angle <= std::numbers::pi))
    fail("energy: angle must lie in [0, pi] rad, got {}", max_angle);
}

double ApproachCone::bounded_value(World& world, double) {
  const Vector3d z = turned(approach_pose(world, hand_).rotation, Vector3d::UnitZ());
  const double angle = std::atan2(z.cross(axis_).norm(), z.dot(axis_));
  return std::max(0.0, angle - max_angle_);
}

// --- KeepOutBox ---

KeepOutBox::KeepOutBox(Id<Robot> hand, const Pose& X_WK, const Vector3d& low, const Vector3d& high)
    : hand_(hand), X_KW_(X_WK.inverse()), low_(low), high_(high) {
  if (!X_WK.is_finite() || !((low.array() <= high.array()).all()))
    fail("energy: expected a box whose low corner is below its high one");
}

double KeepOutBox::bounded_value(World& world, double) {
  double deepest = 0;
  for (const Id<Body> id : world.bodies_of(hand_)) {
    if (!world.body(id).shape) continue;
    const Bounds box = world.body(id).shape->bounds_at(X_KW_ * world.pose(id));
    // the shortest way out
    const double depth = std::min((box.high - low_).minCoeff(), (high_ - box.low).minCoeff());
    deepest = std::max(deepest, depth);
  }
  return energy_length * deepest;
}

// --- ClearanceEnergy ---

ClearanceEnergy::ClearanceEnergy(const HandAndObject& who, double distance)
    : who_(who), distance_(distance) {
  if (!(std::isfinite(distance) && distance >= 0))
    fail("energy: distance must be >= 0 [m], got {}", distance);
}

double ClearanceEnergy::bounded_value(World& world, double) {
  const auto parts = world.bodies_of(who_.hand);
  std::vector<Id<Body>> others;
  for (const Id<Body> id : world.bodies())
    if (id != who_.object && std::ranges::find(parts, id) == parts.end()) others.push_back(id);
  const BodyDistance near = distance(world, parts, others, distance_, &world.context());
  return near.a ? energy_length * (distance_ - near.distance) : 0;
}

// --- ReachEnergy ---

ReachEnergy::ReachEnergy(Id<Robot> hand, const Vector3d& p_W, double radius)
    : hand_(hand), p_W_(p_W), radius_(radius) {
  if (!p_W.allFinite()) fail("energy: point: expected finite coordinates");
  if (!(std::isfinite(radius) && radius >= 0))
    fail("energy: radius must be >= 0 [m], got {}", radius);
}

double ReachEnergy::bounded_value(World& world, double) {
  const double away = (approach_pose(world, hand_).position - p_W_).norm();
  return energy_length * std::max(0.0, away - radius_);
}

// --- PenetrationEnergy ---

// points that cover the vertices evenly: each time the one farthest from those before
static std::vector<Vector3d> spread_points(const std::vector<Vector3d>& vertices, int count) {
  std::vector<Vector3d> out;
  std::vector<double> away(vertices.size(), infinite);
  for (size_t next = 0; static_cast<int>(out.size()) < count;) {
    out.push_back(vertices[next]);
    for (size_t i = 0; i < vertices.size(); ++i)
      away[i] = std::min(away[i], (vertices[i] - out.back()).squaredNorm());
    next = std::ranges::max_element(away) - away.begin();
    if (away[next] == 0) break;
  }
  return out;
}

PenetrationEnergy::PenetrationEnergy(const World& world, Id<Robot> hand, int points) : hand_(hand) {
  if (points < 1 || points > 10000) fail("energy: points: expected 1 to 10000, got {}", points);
  for (const Id<Body> id : world.bodies_of(hand)) {
    const ShapePtr& shape = world.body(id).shape;
    if (!shape) continue;
    parts_.push_back(id);
    points_.push_back(spread_points(shape->mesh().vertices, points));
  }
}

double PenetrationEnergy::depth(World& world, Id<Body> part, Id<Body> other) const {
  const auto i = std::ranges::find(parts_, part) - parts_.begin();
  const Shape& shape = *world.body(other).shape;
  const Pose X_OP = relative_pose(world, other, part);
  double deepest = 0;
  for (const Vector3d& p : points_[i]) {
    const Vector3d p_O = X_OP * p;
    const double away = closest_point(shape, p_O).distance;
    if (away > deepest && contains(shape, p_O)) deepest = away;
  }
  return deepest;
}

double PenetrationEnergy::bounded_value(World& world, double) {
  constexpr double touch = 1e-3;  // of a pair that collides, however shallow [mm]
  double sum = 0;
  const auto mine = [&](Id<Body> id) { return std::ranges::find(parts_, id) != parts_.end(); };
  for (const auto& [a, b] : colliding_pairs(world, parts_, world.bodies(), &world.context())) {
    double deep = mine(a) ? depth(world, a, b) : 0;
    if (mine(b)) deep = std::max(deep, depth(world, b, a));
    sum += energy_length * deep + touch;
  }
  return sum;
}

}  // namespace clench
