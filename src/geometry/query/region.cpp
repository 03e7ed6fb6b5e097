#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/queries.h"

namespace clench {

std::vector<int> region(const Shape& shape, const Eigen::Vector3d& p, double radius) {
  if (!p.allFinite() || std::isnan(radius))
    fail("region: point and radius must be numbers [m], got ({}, {}, {}), {}", p.x(), p.y(), p.z(),
         radius);
  std::vector<int> out;
  const Eigen::Vector3d from = p - Eigen::Vector3d::Map(shape.tree().centre());
  for_near_triangles(shape.tree(), from.data(), rounding_of(shape.bounds(), p), radius, false,
                     [&](int triangle) {
                       if (point_triangle(p, shape.mesh().corners(triangle)).distance < radius)
                         out.push_back(triangle);
                       return false;
                     });
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace clench
