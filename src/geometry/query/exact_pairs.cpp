#include "clench/geometry/query/exact_pairs.h"

#include <limits>

#include "clench/geometry/tree/lanes.h"

namespace clench {

namespace {

// groups that fit one vector: intermediate results stay in registers
using F = Lanes<double, DoubleLanes::width, DoubleLanes::width>;
static_assert(nearest_step % F::count == 0);
using Vector = Triple<F>;

constexpr double outside_face = std::numeric_limits<double>::infinity();

CLENCH_INLINE Vector load(const double (&rows)[9][8], int corner, int first) {
  return {F::stored(rows[3 * corner] + first), F::stored(rows[3 * corner + 1] + first),
          F::stored(rows[3 * corner + 2] + first)};
}
CLENCH_INLINE void store(const Vector& v, double (&rows)[3][8], int first) {
  v.x.store(rows[0] + first), v.y.store(rows[1] + first), v.z.store(rows[2] + first);
}

// NaN becomes 0
CLENCH_INLINE F unit_clamp(const F& x) { return min(max(x, F::all(0)), F::all(1)); }

struct NearestLanes {
  F squared = F::all(std::numeric_limits<double>::infinity());
  Vector p, q;

  CLENCH_INLINE void offer(const F& candidate, const Vector& on_first, const Vector& on_second) {
    const auto nearer = candidate < squared;
    squared = select(nearer, candidate, squared);
    p = select(nearer, on_first, p);
    q = select(nearer, on_second, q);
  }
};

// Nearest points a + s u and b + t v. Crossed lines by cross products, which keep their digits
// where the normal equations lose them: nearly parallel edges are the rule in meshes.
CLENCH_INLINE void offer_segments(const Vector& a, const Vector& u, const F& uu, const Vector& b,
                                  const Vector& v, const F& vv, NearestLanes& best) {
  const F zero = F::all(0);
  const Vector r = a - b, n = cross(u, v);
  const F nn = dot(n, n), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  const F crossed = select(nn > 0.0, unit_clamp(dot(cross(v, r), n) / nn), zero);
  const F free = (uv * crossed + vr) / vv;
  // beyond an end, or if v is a point: that end is the nearest, and u's point is recomputed
  const F t = unit_clamp(free);
  const F s = select((free > 0.0) & (free < 1.0), crossed, unit_clamp((uv * t - ur) / uu));
  const Vector p = a + u.scaled(s), q = b + v.scaled(t), d = (b + v.scaled(t)) - a - u.scaled(s);
  best.offer(dot(d, d), p, q);
}

struct Face {
  Vector corner, u, v, n, across_u, across_v;
  F nn;

  CLENCH_INLINE Face(const Vector& at, const Vector& first, const Vector& back)
      : corner(at), u(first), v{-back.x, -back.y, -back.z}, n(cross(u, v)) {
    across_u = cross(n, u), across_v = cross(v, n), nn = dot(n, n);
  }
  // squared distance of x from its foot on the face; infinity if that lies outside
  CLENCH_INLINE F foot(const Vector& x, Vector& at) const {
    const Vector d = x - corner;
    const F along_u = dot(d, across_v) / nn, along_v = dot(d, across_u) / nn;
    at = corner + u.scaled(along_u) + v.scaled(along_v);
    const Vector rest = x - at;
    const auto outside = (along_u < 0.0) | (along_v < 0.0) | (along_u + along_v > 1.0);
    const F squared = select(outside, F::all(outside_face), dot(rest, rest));
    return select(nn > 0.0, squared, F::all(outside_face));
  }
};

CLENCH_INLINE F largest(const F& least, const Vector& v) {
  return max(max(max(least, abs(v.x)), abs(v.y)), abs(v.z));
}

// those from lane `first` on
void nearest_from(const PairBundle& pairs, int first, NearestBundle& out) {
  Vector a[3], b[3], edge_a[3], edge_b[3];
  F length_a[3], length_b[3], extent = F::all(0);
  for (int k = 0; k < 3; ++k) {
    a[k] = load(pairs.a, k, first), b[k] = load(pairs.b, k, first);
    extent = largest(largest(extent, a[k]), b[k]);
  }
  for (int k = 0; k < 3; ++k) {
    edge_a[k] = a[(k + 1) % 3] - a[k], edge_b[k] = b[(k + 1) % 3] - b[k];
    length_a[k] = dot(edge_a[k], edge_a[k]), length_b[k] = dot(edge_b[k], edge_b[k]);
  }
  NearestLanes best;
  best.p = a[0], best.q = b[0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      offer_segments(a[i], edge_a[i], length_a[i], b[j], edge_b[j], length_b[j], best);
  const Face face_a(a[0], edge_a[0], edge_a[2]), face_b(b[0], edge_b[0], edge_b[2]);
  for (int k = 0; k < 3; ++k) {
    Vector foot;
    const F from_b = face_a.foot(b[k], foot);
    best.offer(from_b, foot, b[k]);
    const F from_a = face_b.foot(a[k], foot);
    best.offer(from_a, a[k], foot);
  }

  const Vector axis = best.q - best.p;
  const F high = max(max(dot(axis, a[0]), dot(axis, a[1])), dot(axis, a[2]));
  const F low = min(min(dot(axis, b[0]), dot(axis, b[1])), dot(axis, b[2]));
  const F sum = abs(axis.x) + abs(axis.y) + abs(axis.z);
  out.apart |= (low - high > extent * sum * projection_rounding).set() << first;
  best.squared.store(out.squared + first);
  store(best.p, out.p, first), store(best.q, out.q, first);
}

}  // namespace

void nearest_of(const PairBundle& pairs, int count, NearestBundle& out) {
  out.apart = 0;
  for (int first = 0; first < count; first += F::count) nearest_from(pairs, first, out);
}

}  // namespace clench
