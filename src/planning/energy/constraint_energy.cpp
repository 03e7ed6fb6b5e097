#include "clench/planning/energy/constraint_energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/model/find.h"
#include "clench/model/penetration.h"

namespace clench {

using Eigen::Vector3d;

static Pose approach_pose(const World& world, Id<Robot> hand) {
  const Robot& robot = world.robot(hand);
  return world.pose(robot.base) * robot.X_BA;
}

EnergyPtr approach_cone_energy(Id<Robot> hand, const Vector3d& axis, double max_angle) {
  if (!axis.allFinite() || axis.isZero(0)) fail("energy: axis: expected a direction");
  if (!(max_angle >= 0 && max_angle <= std::numbers::pi))
    fail("energy: angle must lie in [0, pi] rad, got {}", max_angle);
  return std::make_unique<PlainEnergy>(
      [hand, unit = Vector3d(axis.stableNormalized()), max_angle](const World& world) {
        const Vector3d z = turned(approach_pose(world, hand).rotation, Vector3d::UnitZ());
        const double angle = std::atan2(z.cross(unit).norm(), z.dot(unit));
        return std::max(0.0, angle - max_angle);
      });
}

EnergyPtr keep_out_energy(Id<Robot> hand, const Pose& X_WK, const Vector3d& low,
                          const Vector3d& high) {
  if (!X_WK.is_finite() || !((low.array() <= high.array()).all()))
    fail("energy: expected a box whose low corner is below its high one");
  return std::make_unique<PlainEnergy>(
      [hand, X_KW = X_WK.inverse(), low, high](const World& world) {
        double deepest = 0;
        for (const Id<Body> id : world.bodies_of(hand)) {
          if (!world.body(id).shape) continue;
          const Bounds box = world.body(id).shape->bounds_at(X_KW * world.pose(id));
          // the shortest separating displacement
          const double depth = std::min((box.high - low).minCoeff(), (high - box.low).minCoeff());
          deepest = std::max(deepest, depth);
        }
        return energy_length * deepest;
      });
}

EnergyPtr clearance_energy(const HandAndObject& who, double min_distance) {
  if (!(std::isfinite(min_distance) && min_distance >= 0))
    fail("energy: distance must be >= 0 [m], got {}", min_distance);
  return std::make_unique<PlainEnergy>([who, min_distance](World& world) {
    const auto parts = world.bodies_of(who.hand);
    std::vector<Id<Body>> others;
    for (const Id<Body> id : world.bodies())
      if (id != who.object && std::ranges::find(parts, id) == parts.end()) others.push_back(id);
    const BodyDistance near = distance(world, parts, others, min_distance, &world.context());
    return near.a ? energy_length * (min_distance - near.distance) : 0;
  });
}

EnergyPtr reach_energy(Id<Robot> hand, const Vector3d& p_W, double radius) {
  if (!p_W.allFinite()) fail("energy: point: expected finite coordinates");
  if (!(std::isfinite(radius) && radius >= 0))
    fail("energy: radius must be >= 0 [m], got {}", radius);
  return std::make_unique<PlainEnergy>([hand, p_W, radius](const World& world) {
    const double away = (approach_pose(world, hand).position - p_W).norm();
    return energy_length * std::max(0.0, away - radius);
  });
}

// --- penetration ---

// points distributed evenly over the vertices: each the farthest from those before
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

// Depth of the deepest of a part's points in another body [m].
static double sampled_depth(const World& world, Id<Body> part, const std::vector<Vector3d>& points,
                            Id<Body> other) {
  const Shape& shape = *world.body(other).shape;
  const Pose X_OP = relative_pose(world, other, part);
  double deepest = 0;
  for (const Vector3d& p : points) {
    const Vector3d p_O = X_OP * p;
    const double away = closest_point(shape, p_O).distance;
    if (away > deepest && contains(shape, p_O)) deepest = away;
  }
  return deepest;
}

// Depth of the overlap of a part and another body, to 0.1 mm + 10 %; 0 where both are open [m].
static double overlap_depth(World& world, Id<Body> part, Id<Body> other) {
  const PenetrationOptions options{
      .absolute = 1e-4, .relative = 0.1, .progress = world.context().progress()};
  const double depth = penetration(world, std::span(&part, 1), std::span(&other, 1), options).depth;
  return std::isfinite(depth) ? depth : 0;
}

EnergyPtr penetration_energy(const World& world, Id<Robot> hand, int count) {
  if (count < 1 || count > 10000) fail("energy: points: expected 1 to 10000, got {}", count);
  std::vector<Id<Body>> parts;
  std::vector<std::vector<Vector3d>> points;  // of each part, in its frame
  for (const Id<Body> id : world.bodies_of(hand)) {
    const ShapePtr& shape = world.body(id).shape;
    if (!shape) continue;
    parts.push_back(id);
    points.push_back(spread_points(shape->mesh().vertices, count));
  }
  return std::make_unique<PlainEnergy>([parts, points](World& now) {
    constexpr double touch = 1e-3;  // of a pair that collides, however shallow [mm]
    // 0 for bodies that are not part of the hand
    const auto depth = [&](Id<Body> part, Id<Body> other) {
      const auto at = std::ranges::find(parts, part);
      return at == parts.end() ? 0 : sampled_depth(now, part, points[at - parts.begin()], other);
    };
    double sum = 0;
    for (const auto& [a, b] : colliding_pairs(now, parts, now.bodies(), &now.context())) {
      double deepest = std::max(depth(a, b), depth(b, a));
      // e.g. a rod through a plate has no point inside
      if (deepest == 0) deepest = overlap_depth(now, a, b);
      sum += energy_length * deepest + touch;
    }
    return sum;
  });
}

}  // namespace clench
