// Eight pairs of triangles at once, and a point or ray against eight triangles: bounds that
// eliminate most of them before the exact tests in double precision. For the queries of this module
// only.
//
// Any direction n gives a lower bound, the gap between the two projections on it divided by |n|, so
// n need not be computed accurately. Errors of projections: corners 9 u l per coordinate at most
// (transformed to the other frame), 16 u l along n, products and sums 4 u l more, for both
// triangles and the root 44 u l in all; the query's slack of 64 u l covers it.
#pragma once
#include <limits>

#include "clench/geometry/tree/lanes.h"
#include "clench/geometry/tree/tree.h"

namespace clench {

// error bound of squares of lengths
template <class Real>
inline constexpr Real slightly_more = 1 + 16 * std::numeric_limits<Real>::epsilon();

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

/// The gap between a's projection and b's beyond it along n, not divided by the length of n.
template <class F>
CLENCH_INLINE F projected_gap(const TrianglesOf<F>& a, const TrianglesOf<F>& b,
                              const Triple<F>& n) {
  const F low = min(min(dot(b.corner[0], n), dot(b.corner[1], n)), dot(b.corner[2], n));
  const F high = max(max(dot(a.corner[0], n), dot(a.corner[1], n)), dot(a.corner[2], n));
  return low - high;
}

namespace lanes_detail {

// from the point nearest on segment p + s u to that nearest on q + t v, approximately
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

// the face of eight triangles
template <class F>
struct Face {
  Triple<F> corner, u, v, n, across_u, across_v;
  F nn;

  CLENCH_INLINE Face(const Triple<F>& at, const Triple<F>& first, const Triple<F>& back)
      : corner(at), u(first), v{-back.x, -back.y, -back.z}, n(cross(u, v)) {
    across_u = cross(n, u), across_v = cross(v, n), nn = dot(n, n);
  }
  // From x to a point of the face, approximately its foot. `inside`: does the foot lie inside?
  CLENCH_INLINE Triple<F> to_foot(const Triple<F>& x, typename F::Mask& inside) const {
    const Triple<F> d = x - corner;
    const F along_u = dot(d, across_v) / nn, along_v = dot(d, across_u) / nn, zero = F::all(0);
    inside = (along_u > zero) & (along_v > zero) & (along_u + along_v < F::all(1));
    return u.scaled(along_u) + v.scaled(along_v) - d;
  }
};

}  // namespace lanes_detail

/// From a point of each a to one of b, approximately the nearest ones.
template <class F>
CLENCH_INLINE Triple<F> nearest_way(const TrianglesOf<F>& a, const TrianglesOf<F>& b, F& least) {
  Triple<F> edge_a[3], edge_b[3];
  F length_a[3], length_b[3];
  for (int i = 0; i < 3; ++i) {
    edge_a[i] = a.corner[(i + 1) % 3] - a.corner[i];
    edge_b[i] = b.corner[(i + 1) % 3] - b.corner[i];
    length_a[i] = dot(edge_a[i], edge_a[i]);
    length_b[i] = dot(edge_b[i], edge_b[i]);
  }
  Triple<F> best = b.corner[0] - a.corner[0];
  least = dot(best, best);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Triple<F> d = lanes_detail::between_segments(a.corner[i], edge_a[i], length_a[i],
                                                         b.corner[j], edge_b[j], length_b[j]);
      const F squared = dot(d, d);
      const auto nearer = squared < least;
      least = select(nearer, squared, least);
      best = select(nearer, d, best);
    }
  const lanes_detail::Face<F> face_a(a.corner[0], edge_a[0], edge_a[2]),
      face_b(b.corner[0], edge_b[0], edge_b[2]);
  for (int k = 0; k < 3; ++k) {
    typename F::Mask inside;
    Triple<F> d = face_b.to_foot(a.corner[k], inside);
    F squared = dot(d, d);
    auto nearer = inside & (squared < least);
    least = select(nearer, squared, least);
    best = select(nearer, d, best);
    d = face_a.to_foot(b.corner[k], inside);
    squared = dot(d, d);
    nearer = inside & (squared < least);
    least = select(nearer, squared, least);
    best = select(nearer, {-d.x, -d.y, -d.z}, best);
  }
  return best;
}

/// Certain bounds on the distances of eight pairs, up to slack.
template <class F>
struct NearBounds {
  F low, high;    ///< low is NaN if single precision is not sufficient
  Triple<F> way;  ///< from a to b, `high` long
};

template <class F>
CLENCH_INLINE NearBounds<F> near_bounds(const TrianglesOf<F>& a, const TrianglesOf<F>& b) {
  NearBounds<F> out;
  F squared;
  out.way = nearest_way(a, b, squared);
  out.high = sqrt(squared);
  out.low = projected_gap(a, b, out.way) / out.high;
  return out;
}

/// Are the projections on n separated by more than reach, >= 0?
template <class F>
CLENCH_INLINE typename F::Mask part(const TrianglesOf<F>& a, const TrianglesOf<F>& b,
                                    const Triple<F>& n, typename F::Real reach) {
  const F a0 = dot(a.corner[0], n), a1 = dot(a.corner[1], n), a2 = dot(a.corner[2], n);
  const F b0 = dot(b.corner[0], n), b1 = dot(b.corner[1], n), b2 = dot(b.corner[2], n);
  const F gap =
      max(min(min(b0, b1), b2) - max(max(a0, a1), a2), min(min(a0, a1), a2) - max(max(b0, b1), b2));
  // squares instead of the length of n, as long as they keep their digits
  using Real = typename F::Real;
  constexpr Real least = std::numeric_limits<Real>::min();
  const F nn = dot(n, n), within = nn * (reach * reach * slightly_more<Real>);
  return (gap > Real{0}) & (gap * gap > within) & (nn > least) & (within > least * Real{0x1p30});
}

/// Lanes of pairs that may be within reach, >= 0, by the products of their edges.
template <class F>
CLENCH_INLINE unsigned edges_within_reach(const TrianglesOf<F>& a, const TrianglesOf<F>& b,
                                          typename F::Real reach, unsigned expected) {
  const auto edge = [](const TrianglesOf<F>& t, int i) {
    return t.corner[(i + 1) % 3] - t.corner[i];
  };
  const Triple<F> edge_b[3] = {edge(b, 0), edge(b, 1), edge(b, 2)};
  for (int i = 0; i < 3; ++i) {
    if (!expected) return 0;
    const Triple<F> edge_a = edge(a, i);
    for (int j = 0; j < 3; ++j) expected &= ~part(a, b, cross(edge_a, edge_b[j]), reach).set();
  }
  return expected;
}

/// Certain bounds on the distances of a point from eight triangles, up to slack.
template <class F>
struct PointBounds {
  F squared_high;  ///< the square of an upper bound
  F height;        ///< its square root times a lower bound; that bound itself may be NaN
};

template <class F>
CLENCH_INLINE PointBounds<F> point_bounds(const TrianglesOf<F>& t,
                                          const Triple<typename F::Real>& p) {
  const auto from_p = [&](int k) {
    return Triple<F>{t.corner[k].x - p.x, t.corner[k].y - p.y, t.corner[k].z - p.z};
  };
  const Triple<F> a = from_p(0), b = from_p(1), c = from_p(2), ab = b - a, ac = c - a;
  const F a1 = dot(a, ab), b1 = dot(b, ab), c1 = dot(c, ab), a2 = dot(a, ac), b2 = dot(b, ac),
          c2 = dot(c, ac);
  // these points lie on the triangle for any rounding
  const auto share = [](const F& x, const F& y) {
    return min(max(x / (x - y), F::all(0)), F::all(1));
  };
  Triple<F> best = a + ab.scaled(share(a1, b1));
  F least = dot(best, best);
  const auto offer = [&](const Triple<F>& d, const F& squared, const typename F::Mask& nearer) {
    least = select(nearer, squared, least);
    best = select(nearer, d, best);
  };
  const auto offer_edge = [&](const Triple<F>& d) {
    const F squared = dot(d, d);
    offer(d, squared, squared < least);
  };
  offer_edge(a + ac.scaled(share(a2, c2)));
  offer_edge(b + (c - b).scaled(share(b2 - b1, c2 - c1)));
  // the foot on the plane, by its barycentric coordinates
  const F at_a = b1 * c2 - c1 * b2, at_b = c1 * a2 - a1 * c2, at_c = a1 * b2 - b1 * a2;
  const F scale = F::all(1) / (at_a + at_b + at_c);
  const Triple<F> d = a + ab.scaled(at_b * scale) + ac.scaled(at_c * scale);
  const F squared = dot(d, d), zero = F::all(0);
  offer(d, squared, (at_a > zero) & (at_b > zero) & (at_c > zero) & (squared < least));
  PointBounds<F> out;
  out.squared_high = least;
  out.height = min(min(dot(a, best), dot(b, best)), dot(c, best));
  return out;
}

}  // namespace clench
