#include <cmath>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/ray.h"

namespace clench {

std::optional<RayHit> cast_ray(const Shape& shape, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction, double limit) {
  if (!origin.allFinite() || std::isnan(limit))
    fail("cast_ray: origin and limit must be numbers [m], got ({}, {}, {}), {}", origin.x(),
         origin.y(), origin.z(), limit);
  if (!(std::abs(direction.norm() - 1) < 1e-6))
    fail("cast_ray: direction must be a unit vector, got ({}, {}, {})", direction.x(),
         direction.y(), direction.z());
  const Ray ray(origin, direction);
  RayHit best;
  best.distance = limit;
  ray.for_near_triangles(shape, best.distance, [&](int triangle) {
    const Crossing c = ray.cross(shape.mesh().corners(triangle));
    if (c.kind != Crossing::Kind::hit || c.distance < 0) return false;
    // on a common edge the lower index, so that the order of traversal does not matter
    if (c.distance < best.distance || (c.distance == best.distance && triangle < best.triangle))
      best = {c.distance, origin + c.distance * direction, triangle};
    return false;
  });
  if (best.triangle < 0) return {};
  return best;
}

}  // namespace clench
