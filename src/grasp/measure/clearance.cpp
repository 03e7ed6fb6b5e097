#include "clench/grasp/measure/clearance.h"

#include <algorithm>

namespace clench {

double clearance(const World& world, Id<Robot> hand, Id<Body> object) {
  std::vector<Id<Body>> others;
  for (const Id<Body> id : world.bodies()) {
    const BodyKind kind = world.body(id).kind;
    if (id != object && (kind == BodyKind::object || kind == BodyKind::obstacle))
      others.push_back(id);
  }
  const auto parts = world.bodies_of(hand);
  return distance(world, parts, others).distance;
}

namespace {

// the deepest of a's corners inside b
double deepest_corner(const Body& a, const Body& b, const Pose& X_BA) {
  double deepest = 0;
  for (const Eigen::Vector3d& p_A : a.shape->mesh().vertices) {
    const Eigen::Vector3d p = X_BA * p_A;
    // most corners are outside the other's box
    if ((p.array() < b.shape->bounds().low.array()).any() ||
        (p.array() > b.shape->bounds().high.array()).any() || !contains(*b.shape, p))
      continue;
    deepest = std::max(deepest, closest_point(*b.shape, p).distance);
  }
  return deepest;
}

}  // namespace

double penetration(const World& world, Id<Robot> hand, Id<Body> object) {
  const auto parts = world.bodies_of(hand);
  double deepest = 0;
  for (const auto& [a, b] : colliding_pairs(world, parts, std::span(&object, 1))) {
    const Body &one = world.body(a), &other = world.body(b);
    const Pose X_BA = world.pose(b).inverse() * world.pose(a);
    deepest = std::max(
        {deepest, deepest_corner(one, other, X_BA), deepest_corner(other, one, X_BA.inverse())});
  }
  return deepest;
}

}  // namespace clench
