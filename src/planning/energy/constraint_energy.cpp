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
          // the shortest way out
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

EnergyPtr penetration_energy(const World& world, Id<Robot> hand) {
  std::vector<Id<Body>> parts;
  for (const Id<Body> id : world.bodies_of(hand))
    if (world.body(id).shape) parts.push_back(id);
  return std::make_unique<PlainEnergy>([parts](World& now) {
    constexpr double touch = 1e-3;  // of a pair that collides, however shallow [mm]
    const PenetrationOptions options{
        .absolute = 1e-4, .relative = 0.1, .progress = now.context().progress()};
    // 0 for a body that is no part of the hand
    const auto depth = [&](Id<Body> part, Id<Body> other) {
      if (std::ranges::find(parts, part) == parts.end()) return 0.0;
      const double found =
          penetration(now, std::span(&part, 1), std::span(&other, 1), options).depth;
      return std::isfinite(found) ? found : 0.0;
    };
    double sum = 0;
    for (const auto& [a, b] : colliding_pairs(now, parts, now.bodies(), &now.context()))
      sum += energy_length * std::max(depth(a, b), depth(b, a)) + touch;
    return sum;
  });
}

}  // namespace clench
