#include <array>

#include "clench/base/error.h"
#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/queries.h"

namespace clench {

using Eigen::Vector3d;

ClosestPoint closest_point(const Shape& shape, const Vector3d& p, int seed) {
  if (!p.allFinite())
    fail("closest_point: point must be finite [m], got ({}, {}, {})", p.x(), p.y(), p.z());
  const Mesh& mesh = shape.mesh();
  ClosestPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  // of equally near triangles the first, so that the way here does not show
  const auto judge = [&](int triangle) {
    const Closest c = point_triangle(p, mesh.corners(triangle));
    if (c.distance < best.distance || best.triangle < 0 ||
        (c.distance == best.distance && triangle < best.triangle))
      best = {c.distance, c.q, triangle};
  };
  if (shape.has_triangle(seed)) judge(seed);
  const Vector3d from = p - Vector3d::Map(shape.tree().centre());
  // some at a time, so that the memory of the next ones is on its way
  std::array<int, 16> waiting;
  size_t count = 0;
  const auto judge_waiting = [&] {
    for (size_t i = 0; i < count; ++i)
      for (const int v : mesh.triangles[waiting[i]]) __builtin_prefetch(&mesh.vertices[v]);
    for (size_t i = 0; i < count; ++i) judge(waiting[i]);
    count = 0;
  };
  for_near_triangles(shape.tree(), from.data(), rounding_of(shape.bounds(), p), best.distance, true,
                     [&](int triangle) {
                       if (triangle == seed) return false;
                       __builtin_prefetch(&mesh.triangles[triangle]);
                       waiting[count++] = triangle;
                       if (count == waiting.size()) judge_waiting();
                       return false;
                     });
  judge_waiting();
  return best;
}

std::vector<ClosestPoint> closest_points(const Shape& shape, std::span<const Vector3d> points) {
  std::vector<ClosestPoint> out;
  out.reserve(points.size());
  for (const Vector3d& p : points)
    out.push_back(closest_point(shape, p, out.empty() ? -1 : out.back().triangle));
  return out;
}

}  // namespace clench
