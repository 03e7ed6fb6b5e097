#include "clench/geometry/query/exact_points.h"

#include <limits>

namespace clench {

namespace {

using PointLanes = Lanes<double, point_step, point_step>;
using PointTriple = Triple<PointLanes>;

CLENCH_INLINE PointTriple corner(const CornerLanes& triangles, int k) {
  const auto coordinate = [&](int m) {
    PointLanes out;
    for (int i = 0; i < point_step; ++i)
      out.chunk[i / PointLanes::width][i % PointLanes::width] = triangles.at[k][i][m];
    return out;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

struct Best {
  PointLanes squared = PointLanes::all(std::numeric_limits<double>::infinity());
  PointTriple q = {PointLanes::all(0), PointLanes::all(0), PointLanes::all(0)};

  CLENCH_INLINE void offer(const PointLanes& candidate, const PointTriple& on_triangle) {
    const auto nearer = candidate < squared;
    squared = select(nearer, candidate, squared);
    q = select(nearer, on_triangle, q);
  }
};

CLENCH_INLINE PointLanes squared_length(const PointTriple& v) { return dot(v, v); }

}  // namespace

// point_triangle step by step, its branches as selections
void nearest_to_point(const double at[3], const CornerLanes& triangles, NearestToPoint& out) {
  const PointLanes zero = PointLanes::all(0), one = PointLanes::all(1);
  const PointTriple p = {PointLanes::all(at[0]), PointLanes::all(at[1]), PointLanes::all(at[2])};
  const PointTriple a[3] = {corner(triangles, 0), corner(triangles, 1), corner(triangles, 2)};
  const PointTriple edge[3] = {a[1] - a[0], a[2] - a[1], a[0] - a[2]};
  Best best;
  for (int i = 0; i < 3; ++i) {
    const PointLanes length = squared_length(edge[i]);
    // NaN becomes 0
    const PointLanes t = min(max(dot(edge[i], p - a[i]) / length, zero), one);
    const PointTriple q = a[i] + edge[i].scaled(select(length > 0.0, t, zero));
    best.offer(squared_length(p - q), q);
  }

  // the foot on the plane
  const PointTriple u = edge[0], v = {-edge[2].x, -edge[2].y, -edge[2].z}, d = p - a[0];
  const PointTriple normal = cross(edge[0], edge[1]);
  const PointLanes nn = squared_length(normal), height = dot(d, normal);
  const PointLanes along_u = dot(cross(d, v), normal) / nn, along_v = dot(cross(u, d), normal) / nn;
  const PointTriple foot = a[0] + u.scaled(along_u) + v.scaled(along_v);
  const auto inside = (nn > 0.0) & (height * height < best.squared * nn) & (along_u >= 0.0) &
                      (along_v >= 0.0) & (along_u + along_v <= 1.0);
  best.offer(select(inside, squared_length(p - foot), best.squared), foot);
  best.squared.store(out.squared);
  best.q.x.store(out.q[0]), best.q.y.store(out.q[1]), best.q.z.store(out.q[2]);
}

}  // namespace clench
