#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "geometry/queries.h"
#include "geometry/tree.h"

namespace clench {

using Eigen::Vector3d;

namespace {

void check_point(const Vector3d& p, const char* query) {
  if (!p.allFinite())
    fail("{}: point must be finite [m], got ({}, {}, {})", query, p.x(), p.y(), p.z());
}

// How often the surface winds about p, counter-clockwise from outside: solid angles over 4 pi.
// source  van Oosterom & Strackee (1983); Jacobson, Kavan & Sorkine-Hornung (2013)
double winding_number(const Mesh& mesh, const Vector3d& p) {
  double sum = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    auto c = mesh.corners(static_cast<int>(i));
    for (Vector3d& corner : c) corner -= p;
    const double la = c[0].norm(), lb = c[1].norm(), lc = c[2].norm();
    const double triple = c[0].dot((c[1] - c[0]).cross(c[2] - c[0]));
    const double below =
        la * lb * lc + c[0].dot(c[1]) * lc + c[1].dot(c[2]) * la + c[2].dot(c[0]) * lb;
    sum += 2 * std::atan2(triple, below);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace

ClosestPoint closest_point(const Shape& shape, const Vector3d& p, int seed) {
  check_point(p, "closest_point");
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

bool contains(const Shape& shape, const Vector3d& p) {
  check_point(p, "contains");
  if (!shape.closed() || !shape.bounds().holds(p)) return false;
  return std::abs(winding_number(shape.mesh(), p)) > 0.5;
}

}  // namespace clench
