#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "clench/geometry/tree/box_lanes.h"
#include "clench/geometry/tree/precision.h"
#include "clench/geometry/tree/triangle_lanes.h"
#include "clench/geometry/tree/walk.h"

namespace clench {

namespace {

template <class Real>
struct Task {
  Real bound;
  int32_t child;
};

template <class Real>
Triple<Real> triple(const double v[3]) {
  return {static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
}

// Depth first, the child of smallest bound on top. bounds(boxes) returns eight of them, or their
// squares if limit() is one; judge(leaf) ends the traversal by returning true; limit() may decrease
// meanwhile.
template <class F, class Bounds, class Judge, class Limit>
bool walk(const Tree& tree, Bounds&& bounds, Judge&& judge, Limit&& limit) {
  using Real = typename F::Real;
  Task<Real> stack[8 * deepest_tree + 8];
  int height = 0;
  // bundle 0 contains a single box
  stack[height++] = {std::numeric_limits<Real>::lowest(), tree.boxes(0).child[0]};
  while (height > 0) {
    Task<Real> task = stack[--height];
    if (task.bound > limit()) continue;
    // descends to the child of smallest bound, while the others wait unsorted: sorting would cost
    // more than it saves
    while (!(task.child & 1)) {
      const BoxBundle& from = tree.boxes(task.child >> 1);
      const F gaps = bounds(load_boxes<F>(from));
      unsigned near = used_lanes(from.child) & ~(gaps > limit()).set();
      if (!near) break;
      const unsigned least = near & (gaps <= min_of(gaps)).set();
      const int next = __builtin_ctz(least ? least : near);
      near ^= 1u << next;
      Real values[8];
      gaps.store(values);
      // branch-free, as branches would be mispredicted
      for (int lane = 0; lane < 8; ++lane) {
        stack[height] = {values[lane], from.child[lane]};
        height += near >> lane & 1;
      }
      task = {values[next], from.child[next]};
    }
    if ((task.child & 1) && judge(tree.leaf(task.child >> 1))) return true;
  }
  return false;
}

double length_of(const double v[3]) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

// Candidates for the nearest, until they are certain: the first ones in registers, more of them in
// memory.
template <class Real>
class Candidates {
 public:
  void add(Real low, int triangle) {
    if (count_ < at_hand)
      first_[count_++] = {low, triangle};
    else
      more_.push_back({low, triangle});
  }
  void visit(Real limit, TriangleVisit visitor) const {
    const auto judge = [&](const Candidate& c) {
      if (!(c.low > limit)) visitor(c.triangle);
    };
    std::for_each(first_, first_ + count_, judge);
    std::for_each(more_.begin(), more_.end(), judge);
  }

 private:
  static constexpr int at_hand = 48;
  struct Candidate {
    Real low;
    int triangle;
  };
  Candidate first_[at_hand];
  int count_ = 0;
  std::vector<Candidate> more_;
};

template <class F>
void near_point(const Tree& tree, const double at[3], double extent, double rounding, double reach,
                bool nearest_only, TriangleVisit visit) {
  using Real = typename F::Real;
  Candidates<Real> found;
  const Triple<Real> p = triple<Real>(at);
  const Real slack = slack_of<Real>(extent, tree.radius(), rounding);
  constexpr Real up = 1 + 4 * std::numeric_limits<Real>::epsilon();
  Real limit = at_least<Real>(reach) + slack, squared_limit = limit * limit * up;
  Real squared_high = std::numeric_limits<Real>::infinity();
  const auto judge = [&](const TriangleBundle& leaf) {
    const PointBounds<F> bounds = point_bounds(load_triangles<F>(leaf), p);
    if (const Real squared = min_of(bounds.squared_high); nearest_only && squared < squared_high) {
      squared_high = squared;
      const Real high = std::sqrt(squared) + 2 * slack;
      if (high < limit) limit = high, squared_limit = limit * limit * up;
    }
    // lower bounds by squares: NaN bounds are kept
    const auto beyond = (bounds.height > Real{0}) &
                        (bounds.height * bounds.height > bounds.squared_high * squared_limit);
    unsigned left = used_lanes(leaf.triangle) & ~beyond.set();
    if (!left) return false;
    Real height[8], squared[8];
    bounds.height.store(height), bounds.squared_high.store(squared);
    for (; left; left &= left - 1) {
      const int k = __builtin_ctz(left);
      found.add(height[k] / std::sqrt(squared[k]), leaf.triangle[k]);
    }
    return false;
  };
  walk<F>(
      tree, [&](const BoxOf<F>& eight) { return squared_point_gaps(eight, p); }, judge,
      [&] { return squared_limit; });
  found.visit(limit, visit);
}

// Distance at which a ray enters eight boxes enlarged by slack, at least 0; infinity if it misses.
template <class F>
CLENCH_INLINE F ray_gaps(const BoxOf<F>& eight, const Triple<typename F::Real>& origin,
                         const Triple<typename F::Real>& direction, typename F::Real slack) {
  using Real = typename F::Real;
  const F infinite = F::all(std::numeric_limits<Real>::infinity());
  const Triple<F> to = {eight.center.x - origin.x, eight.center.y - origin.y,
                        eight.center.z - origin.z};
  F low = F::all(0), high = infinite;
  for (int k = 0; k < 3; ++k) {
    const F middle = dot(eight.axis[k], to), speed = dot(eight.axis[k], direction);
    const F half = eight.half[k] + slack;
    // a ray parallel to the slab is inside it completely or never; one whose component is lost in
    // rounding, too
    const auto still = abs(speed) < std::numeric_limits<Real>::epsilon();
    const F s = (middle - half) / speed, t = (middle + half) / speed;
    const auto outside = abs(middle) > half;
    low = max(low, select(still, select(outside, infinite, F::all(0)), min(s, t)));
    high = min(high, select(still, infinite, max(s, t)));
  }
  return select(low > high, infinite, low);
}

template <class F>
CLENCH_INLINE const F& coordinate(const Triple<F>& v, int i) {
  return i == 0 ? v.x : i == 1 ? v.y : v.z;
}

// Triangles that the ray may hit, by their projections on it, and lower bounds of their distances.
template <class F>
CLENCH_INLINE unsigned crossed(const TrianglesOf<F>& t, const Triple<typename F::Real>& origin,
                               const Triple<typename F::Real>& direction, typename F::Real slack,
                               F& begin) {
  using Real = typename F::Real;
  const Real d[3] = {direction.x, direction.y, direction.z};
  int z = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(d[i]) > std::abs(d[z])) z = i;
  const int x = (z + 1) % 3, y = (z + 2) % 3;
  F across[2][3], along[3];
  for (int k = 0; k < 3; ++k) {
    const Triple<F> p = {t.corner[k].x - origin.x, t.corner[k].y - origin.y,
                         t.corner[k].z - origin.z};
    across[0][k] = coordinate(p, x) - coordinate(p, z) * (d[x] / d[z]);
    across[1][k] = coordinate(p, y) - coordinate(p, z) * (d[y] / d[z]);
    along[k] = dot(p, direction);
  }
  begin = min(min(along[0], along[1]), along[2]);
  auto missed = max(max(along[0], along[1]), along[2]) < -slack;
  for (const auto& c : across)
    missed = missed | (min(min(c[0], c[1]), c[2]) > slack) | (max(max(c[0], c[1]), c[2]) < -slack);
  return ~missed.set();
}

template <class F>
bool crossed_by_ray(const Tree& tree, const double from[3], const double towards[3], double extent,
                    double rounding, double passed, const double& most, TriangleVisit visit) {
  using Real = typename F::Real;
  const Triple<Real> origin = triple<Real>(from), direction = triple<Real>(towards);
  const Real slack = slack_of<Real>(extent, tree.radius(), rounding);
  // finite, so that infinity is beyond it
  const auto limit = [&] {
    return std::min(at_least<Real>(most - passed) + slack, std::numeric_limits<Real>::max());
  };
  const auto judge = [&](const TriangleBundle& leaf) {
    F begin;
    unsigned left = crossed(load_triangles<F>(leaf), origin, direction, slack, begin) &
                    used_lanes(leaf.triangle);
    Real begins[8];
    begin.store(begins);
    for (; left; left &= left - 1) {
      const int k = __builtin_ctz(left);
      if (!(begins[k] > limit()) && visit(leaf.triangle[k])) return true;
    }
    return false;
  };
  return walk<F>(
      tree, [&](const BoxOf<F>& eight) { return ray_gaps(eight, origin, direction, slack); }, judge,
      limit);
}

}  // namespace

void for_near_triangles(const Tree& tree, const double p[3], double rounding, double reach,
                        bool nearest_only, TriangleVisit visit) {
  const double extent = length_of(p) + tree.radius();
  if (single_is_enough(extent, tree.radius()))
    near_point<FloatLanes>(tree, p, extent, rounding, reach, nearest_only, visit);
  else
    near_point<DoubleLanes>(tree, p, extent, rounding, reach, nearest_only, visit);
}

bool for_crossed_triangles(const Tree& tree, const double origin[3], const double direction[3],
                           double rounding, const double& limit, TriangleVisit visit) {
  // starts where the ray enters the sphere about the tree, so that a distant origin costs no digits
  const double along =
      -(origin[0] * direction[0] + origin[1] * direction[1] + origin[2] * direction[2]);
  const double passed = std::max(0.0, along - 2 * tree.radius());
  double from[3];
  for (int i = 0; i < 3; ++i) from[i] = origin[i] + passed * direction[i];
  const double extent = length_of(from) + 2 * tree.radius();
  return single_is_enough(extent, tree.radius())
             ? crossed_by_ray<FloatLanes>(tree, from, direction, extent, rounding, passed, limit,
                                          visit)
             : crossed_by_ray<DoubleLanes>(tree, from, direction, extent, rounding, passed, limit,
                                           visit);
}

}  // namespace clench
