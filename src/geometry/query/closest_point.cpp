#include <algorithm>
#include <array>
#include <cmath>

#include "clench/base/error.h"
#include "clench/geometry/query/exact_points.h"
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
  // of equally near triangles the first, so that the order of traversal does not matter
  const auto take = [&](double distance, const Vector3d& q, int triangle) {
    if (distance < best.distance || best.triangle < 0 ||
        (distance == best.distance && triangle < best.triangle))
      best = {distance, q, triangle};
  };
  // in groups, so that memory of the next ones is prefetched
  std::array<int, 16> waiting;
  int count = 0;
  const auto judge_waiting = [&] {
    for (int i = 0; i < count; ++i)
      for (const int v : mesh.triangles[waiting[i]]) __builtin_prefetch(&mesh.vertices[v]);
    for (int first = 0; first < count; first += point_step) {
      const int here = std::min(point_step, count - first);
      CornerLanes corners;
      for (int lane = 0; lane < point_step; ++lane) {
        const auto& triangle = mesh.triangles[waiting[first + std::min(lane, here - 1)]];
        for (int k = 0; k < 3; ++k) corners.at[k][lane] = mesh.vertices[triangle[k]].data();
      }
      NearestToPoint nearest;
      nearest_to_point(p.data(), corners, nearest);
      for (int lane = 0; lane < here; ++lane)
        take(std::sqrt(nearest.squared[lane]),
             {nearest.q[0][lane], nearest.q[1][lane], nearest.q[2][lane]}, waiting[first + lane]);
    }
    count = 0;
  };
  const Vector3d from = p - Vector3d::Map(shape.tree().center());
  const double rounding = rounding_of(shape.bounds(), p);
  // the result is at least as near as the corners of the seed
  double reach = std::numeric_limits<double>::infinity();
  if (shape.has_triangle(seed)) {
    for (const int v : mesh.triangles[seed]) reach = std::min(reach, (mesh.vertices[v] - p).norm());
    reach += rounding;
  }
  for_near_triangles(shape.tree(), from.data(), rounding, reach, true, [&](int triangle) {
    __builtin_prefetch(&mesh.triangles[triangle]);
    waiting[count++] = triangle;
    if (count == static_cast<int>(waiting.size())) judge_waiting();
    return false;
  });
  judge_waiting();
  return best;
}

}  // namespace clench
