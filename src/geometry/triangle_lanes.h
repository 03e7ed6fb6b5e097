// Eight pairs of triangles at once, and a point or ray against eight triangles: bounds that let most
// of them go before the exact tests in double. For the queries of this module only.
//
// Any direction n gives a lower bound, the gap between the two shadows along it over |n|, so how n
// was found need not be exact. The shadows are: corners off by 9 u l a coordinate at most (moved into
// the other frame), 16 u l along n, products and sums by 4 u l more, of both triangles and the root
// 44 u l in all; the query's slack of 64 u l covers it.
#pragma once
#include "geometry/lanes.h"
#include "geometry/tree.h"

namespace clench {

template <class F>
struct TrianglesOf {
  Triple<F> corner[3];
};

template <class F>
CLENCH_INLINE TrianglesOf<F> load_triangles(const TriangleBundle& from) {
  TrianglesOf<F> out;
  for (int k = 0; k < 3; ++k)
    out.corner[k] = {F::load(from.corners[3 * k]), F::load(from.corners[3 * k + 1]),
                     F::load(from.corners[3 * k + 2])};
  return out;
}

template <class F>
CLENCH_INLINE TrianglesOf<F> moved(const TrianglesOf<F>& from, const Move<typename F::Real>& move) {
  return {{move(from.corner[0]), move(from.corner[1]), move(from.corner[2])}};
}

/// lane i of the result is lane index[i]
template <class F>
CLENCH_INLINE TrianglesOf<F> pick(const TrianglesOf<F>& from, const int32_t* index) {
  TrianglesOf<F> out;
  for (int k = 0; k < 3; ++k)
    out.corner[k] = {from.corner[k].x.pick(index), from.corner[k].y.pick(index),
                     from.corner[k].z.pick(index)};
  return out;
}

/// The gap of a's shadow below b's along n, not divided by the length of n.
template <class F>
CLENCH_INLINE F shadow_gap(const TrianglesOf<F>& a, const TrianglesOf<F>& b, const Triple<F>& n) {
  const F low = min(min(dot(b.corner[0], n), dot(b.corner[1], n)), dot(b.corner[2], n));
  const F high = max(max(dot(a.corner[0], n), dot(a.corner[1], n)), dot(a.corner[2], n));
  return low - high;
}

namespace lanes_detail {

// from the point nearest on segment p + s u to that nearest on q + t v, roughly
template <class F>
CLENCH_INLINE Triple<F> between_segments(const Triple<F>& p, const Triple<F>& u, const F& uu,
                                         const Triple<F>& q, const Triple<F>& v, const F& vv) {
  const F zero = F::all(0), one = F::all(1);
  const Triple<F> r = q - p;
  const F uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  F s = min(max((ur * vv - vr * uv) / (uu * vv - uv * uv), zero), one);
  const F t = min(max((uv * s - vr) / vv, zero), one);
  s = min(max((uv * t + ur) / uu, zero), one);
  return r + v.scaled(t) - u.scaled(s);
}

// Is x above or below the triangle with edges u and v from corner? height: along the normal.
template <class F>
CLENCH_INLINE typename F::Mask over_face(const Triple<F>& d, const Triple<F>& n,
                                         const Triple<F>& across_u, const Triple<F>& across_v,
                                         const F& nn, F& height) {
  height = dot(d, n);
  const F along_u = dot(d, across_v), along_v = dot(d, across_u), zero = F::all(0);
  return (along_u > zero) & (along_v > zero) & (along_u + along_v < nn);
}

}  // namespace lanes_detail

/// From the nearest point on a to that on b, roughly.
template <class F>
CLENCH_INLINE Triple<F> nearest_direction(const TrianglesOf<F>& a, const TrianglesOf<F>& b) {
  Triple<F> edge_a[3], edge_b[3];
  F length_a[3], length_b[3];
  for (int i = 0; i < 3; ++i) {
    edge_a[i] = a.corner[(i + 1) % 3] - a.corner[i];
    edge_b[i] = b.corner[(i + 1) % 3] - b.corner[i];
    length_a[i] = dot(edge_a[i], edge_a[i]);
    length_b[i] = dot(edge_b[i], edge_b[i]);
  }
  Triple<F> best = b.corner[0] - a.corner[0];
  F least = dot(best, best);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Triple<F> d = lanes_detail::between_segments(a.corner[i], edge_a[i], length_a[i],
                                                         b.corner[j], edge_b[j], length_b[j]);
      const F squared = dot(d, d);
      const auto nearer = squared < least;
      least = select(nearer, squared, least);
      best = select(nearer, d, best);
    }
  const auto faces = [&](const TrianglesOf<F>& face, const Triple<F>(&edge)[3],
                         const TrianglesOf<F>& points, typename F::Real sign) {
    // edge 2 runs back to corner 0
    const Triple<F> u = edge[0], v = {-edge[2].x, -edge[2].y, -edge[2].z};
    const Triple<F> n = cross(u, v), across_u = cross(n, u), across_v = cross(v, n);
    const F nn = dot(n, n);
    for (int k = 0; k < 3; ++k) {
      F height;
      const auto over = lanes_detail::over_face(points.corner[k] - face.corner[0], n, across_u,
                                                across_v, nn, height);
      const F squared = height * height / nn;
      const auto nearer = over & (squared < least);
      least = select(nearer, squared, least);
      best = select(nearer, n.scaled(height * sign), best);
    }
  };
  faces(a, edge_a, b, 1);
  faces(b, edge_b, a, -1);
  return best;
}

/// Lower bounds of the distances of a and b, near to exact where single precision tells; not a
/// number where it does not.
template <class F>
CLENCH_INLINE F nearest_bounds(const TrianglesOf<F>& a, const TrianglesOf<F>& b) {
  const Triple<F> n = nearest_direction(a, b);
  return shadow_gap(a, b, n) / sqrt(dot(n, n));
}

/// Do the shadows along n stay apart by more than slack?
template <class F>
CLENCH_INLINE typename F::Mask part(const TrianglesOf<F>& a, const TrianglesOf<F>& b,
                                    const Triple<F>& n, typename F::Real slack) {
  // the sum of the coordinates is no less than the length
  const F enough = (abs(n.x) + abs(n.y) + abs(n.z)) * slack;
  return max(shadow_gap(a, b, n), shadow_gap(b, a, n)) > enough;
}

/// Lanes of those that may meet, as far as the usual axes tell: normals and products of edges.
template <class F>
CLENCH_INLINE unsigned may_meet(const TrianglesOf<F>& a, const TrianglesOf<F>& b,
                                typename F::Real slack, unsigned wanted) {
  Triple<F> edge_a[3], edge_b[3];
  for (int i = 0; i < 3; ++i) {
    edge_a[i] = a.corner[(i + 1) % 3] - a.corner[i];
    edge_b[i] = b.corner[(i + 1) % 3] - b.corner[i];
  }
  wanted &= ~part(a, b, cross(edge_a[0], edge_a[1]), slack).set();
  if (!wanted) return 0;
  wanted &= ~part(a, b, cross(edge_b[0], edge_b[1]), slack).set();
  for (int i = 0; i < 3; ++i) {
    if (!wanted) return 0;
    for (int j = 0; j < 3; ++j) wanted &= ~part(a, b, cross(edge_a[i], edge_b[j]), slack).set();
  }
  return wanted;
}

/// Lower bounds of the distances of a point from eight triangles, as nearest_bounds.
template <class F>
CLENCH_INLINE F point_bounds(const TrianglesOf<F>& t, const Triple<typename F::Real>& p) {
  const F zero = F::all(0), one = F::all(1);
  Triple<F> to[3], edge[3];
  for (int k = 0; k < 3; ++k)
    to[k] = {t.corner[k].x - p.x, t.corner[k].y - p.y, t.corner[k].z - p.z};
  for (int k = 0; k < 3; ++k) edge[k] = to[(k + 1) % 3] - to[k];
  Triple<F> best = to[0];
  F least = dot(best, best);
  for (int k = 0; k < 3; ++k) {
    const F s = min(max(-dot(to[k], edge[k]) / dot(edge[k], edge[k]), zero), one);
    const Triple<F> d = to[k] + edge[k].scaled(s);
    const F squared = dot(d, d);
    const auto nearer = squared < least;
    least = select(nearer, squared, least);
    best = select(nearer, d, best);
  }
  const Triple<F> u = edge[0], v = {-edge[2].x, -edge[2].y, -edge[2].z}, n = cross(u, v);
  const Triple<F> from = {-to[0].x, -to[0].y, -to[0].z};
  F height;
  const F nn = dot(n, n);
  const auto over = lanes_detail::over_face(from, n, cross(n, u), cross(v, n), nn, height);
  best = select(over & (height * height / nn < least), n.scaled(-height), best);
  const F low = min(min(dot(to[0], best), dot(to[1], best)), dot(to[2], best));
  return low / sqrt(dot(best, best));
}

}  // namespace clench
