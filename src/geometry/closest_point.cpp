#include "base/error.h"
#include "geometry/placement.h"
#include "geometry/queries.h"

namespace clench {

using Eigen::Vector3d;

ClosestPoint closest_point(const Shape& shape, const Vector3d& p, int seed) {
  if (!p.allFinite())
    fail("closest_point: point must be finite [m], got ({}, {}, {})", p.x(), p.y(), p.z());
  const Mesh& mesh = shape.mesh();
  ClosestPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  // of equally near triangles the first, so that the way here does not show
  const auto visit = [&](int triangle) {
    const Closest c = point_triangle(p, mesh.corners(triangle));
    if (c.distance < best.distance || best.triangle < 0 ||
        (c.distance == best.distance && triangle < best.triangle))
      best = {c.distance, c.q, triangle};
  };
  if (shape.has_triangle(seed)) visit(seed);
  const Vector3d from = p - Vector3d::Map(shape.tree().centre());
  std::vector<int> near;
  find_near_triangles(shape.tree(), from.data(), rounding_of(shape.bounds(), p), best.distance,
                      true, near);
  for (const int triangle : near) visit(triangle);
  return best;
}

}  // namespace clench
