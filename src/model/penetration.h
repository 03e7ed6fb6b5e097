// Penetration depth of bodies of a world.
#pragma once
#include <span>

#include "clench/geometry/query/penetration.h"
#include "clench/model/world.h"

namespace clench {

struct BodyPenetration {
  /// [m]; 0 without an overlap, infinite if two open meshes intersect: neither has an inside
  double depth = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< the deepest point found
  Id<Body> a, b;                                  ///< the pair with the deepest overlap
};

/// The largest distance, from the surface of a body of `b`, of a point of a body of `a` inside it.
/// If the mesh in `b` is open, and so has no inside, the roles of the two are exchanged.
/// Switched-off pairs are measured, too.
/// throws Stopped
BodyPenetration penetration(const World& world, std::span<const Id<Body>> a,
                            std::span<const Id<Body>> b, const PenetrationOptions& options = {});

}  // namespace clench
