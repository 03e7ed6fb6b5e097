#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/queries.h"

namespace clench {

// Is a corner clearly within the radius? Then the distance of the triangle need not be computed.
static bool has_corner_within(const Corners& corners, const Eigen::Vector3d& p, double radius) {
  if (radius <= 0) return false;
  const double clearly = (1 - 1e-9) * radius * radius;
  for (const Eigen::Vector3d& corner : corners)
    if ((corner - p).squaredNorm() < clearly) return true;
  return false;
}

std::vector<int> region(const Shape& shape, const Eigen::Vector3d& p, double radius) {
  if (!p.allFinite() || std::isnan(radius))
    fail("region: point and radius must be numbers [m], got ({}, {}, {}), {}", p.x(), p.y(), p.z(),
         radius);
  std::vector<int> out;
  const Eigen::Vector3d from = p - Eigen::Vector3d::Map(shape.tree().center());
  for_near_triangles(
      shape.tree(), from.data(), rounding_of(shape.bounds(), p), radius, false, [&](int triangle) {
        const Corners corners = shape.mesh().corners(triangle);
        if (has_corner_within(corners, p, radius) || point_triangle(p, corners).distance < radius)
          out.push_back(triangle);
        return false;
      });
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace clench
