#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "base/error.h"
#include "geometry/queries.h"
#include "geometry/tree.h"

namespace clench {

using Eigen::Vector3d;

ClosestPoint closest_point(const Shape& shape, const Vector3d& p, int seed) {
  if (!p.allFinite())
    fail("closest_point: point must be finite [m], got ({}, {}, {})", p.x(), p.y(), p.z());
  const Mesh& mesh = shape.mesh();
  const Tree& tree = shape.tree();
  ClosestPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto visit = [&](int triangle) {
    const Closest c = point_triangle(p, mesh.corners(triangle));
    if (c.distance < best.distance || best.triangle < 0) best = {c.distance, c.q, triangle};
  };
  if (shape.has_triangle(seed)) visit(seed);

  // nearer child first, the farther one waits on the stack
  const double slack = box_slack(shape.bounds(), p);
  const auto bound = [&](int node) {
    return std::sqrt(tree.node(node).box.squared_distance(p)) - slack;
  };
  std::array<std::pair<double, int>, 256> stack;  // deeper than any tree is
  int height = 0;
  stack[height++] = {bound(0), 0};
  while (height > 0) {
    auto [least, at] = stack[--height];
    while (least <= best.distance && !tree.node(at).leaf()) {
      int near = at + 1, far = tree.node(at).right;
      double near_bound = bound(near), far_bound = bound(far);
      if (far_bound < near_bound) std::swap(near, far), std::swap(near_bound, far_bound);
      stack[height++] = {far_bound, far};
      at = near, least = near_bound;
    }
    if (least <= best.distance) visit(tree.node(at).triangle);
  }
  return best;
}

}  // namespace clench
