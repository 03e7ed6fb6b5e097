#include <cmath>
#include <limits>

#include "geometry/box_lanes.h"
#include "geometry/precision.h"
#include "geometry/triangle_lanes.h"
#include "geometry/walk.h"

namespace clench {

namespace {

template <class Real>
Move<Real> move_of(const TreePair& pair) {
  const auto& r = pair.rotation;
  const auto& o = pair.offset;
  const auto real = [](double x) { return static_cast<Real>(x); };
  return {{{real(r[0]), real(r[1]), real(r[2])},
           {real(r[3]), real(r[4]), real(r[5])},
           {real(r[6]), real(r[7]), real(r[8])}},
          {real(o[0]), real(o[1]), real(o[2])}};
}

template <class Real>
Move<Real> back_of(const TreePair& pair) {
  const auto& r = pair.rotation;
  const auto& o = pair.offset;
  TreePair back{pair.b, pair.a, {}, {}, 0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) back.rotation[3 * i + j] = r[3 * j + i];
    back.offset[i] = -(r[i] * o[0] + r[3 + i] * o[1] + r[6 + i] * o[2]);
  }
  return move_of<Real>(back);
}

template <class F>
class PairWalk {
  using Real = typename F::Real;

 public:
  PairWalk(const TreePair& pair, double extent)
      : a_(*pair.a),
        b_(*pair.b),
        b_to_a_(move_of<Real>(pair)),
        a_to_b_(back_of<Real>(pair)),
        slack_(slack_of<Real>(extent, a_.radius() + b_.radius(), pair.rounding)) {}

  bool near(const Reach& reach, PairVisit visit) {
    reach_ = &reach;
    take_reach();
    return run([&](int leaf_a, int leaf_b) { return near_leaves(leaf_a, leaf_b, visit); });
  }

  bool meeting(PairVisit visit) {
    const Reach touching{0};
    reach_ = &touching;
    take_reach();
    return run([&](int leaf_a, int leaf_b) { return meeting_leaves(leaf_a, leaf_b, visit); });
  }

 private:
  // boxes are named by eight times their bundle and their lane
  struct Task {
    Real bound;
    int32_t box_a, box_b;
  };

  static int child(const Tree& tree, int box) { return tree.boxes(box / 8).child[box % 8]; }
  static Real size(const Tree& tree, int box) { return tree.boxes(box / 8).size[box % 8]; }

  // what the reach says in the precision of the walk; bounds beyond the limit are let go
  void take_reach() {
    limit_ = at_least<Real>(reach_->distance) + slack_;
    // beyond it squares would overflow
    squared_limit_ =
        limit_ < 0 ? Real{-1} : limit_ * limit_ * (1 + 4 * std::numeric_limits<Real>::epsilon());
    const double *n = reach_->along, length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    guided_ = length > 1e-150;
    if (!guided_) return;
    along_a_ = {static_cast<Real>(n[0] / length), static_cast<Real>(n[1] / length),
                static_cast<Real>(n[2] / length)};
    along_b_ = a_to_b_.turned(along_a_);
  }

  template <class Leaves>
  bool run(Leaves&& leaves) {
    Task stack[16 * deepest_tree];
    int height = 0;
    stack[height++] = {std::numeric_limits<Real>::lowest(), 0, 0};
    while (height > 0) {
      const Task task = stack[--height];
      if (task.bound > limit_) continue;
      const int child_a = child(a_, task.box_a), child_b = child(b_, task.box_b);
      const bool leaf_a = child_a & 1, leaf_b = child_b & 1;
      if (leaf_a && leaf_b) {
        if (leaves(child_a >> 1, child_b >> 1)) return true;
        continue;
      }
      // open the larger box
      const bool open_a = !leaf_a && (leaf_b || size(a_, task.box_a) >= size(b_, task.box_b));
      const int below = (open_a ? child_a : child_b) >> 1;
      Real bounds[8];
      unsigned near = open_a ? open(a_, below, b_, task.box_b, b_to_a_, along_a_, 1, bounds)
                             : open(b_, below, a_, task.box_a, a_to_b_, along_b_, -1, bounds);
      // the nearest one on top of the stack
      for (const int first = height; near; near &= near - 1) {
        const int lane = __builtin_ctz(near), box = 8 * below + lane;
        const Task next{bounds[lane], open_a ? box : task.box_a, open_a ? task.box_b : box};
        int at = height++;
        for (; at > first && stack[at - 1].bound < next.bound; --at) stack[at] = stack[at - 1];
        stack[at] = next;
      }
    }
    return false;
  }

  // Bounds of the eight boxes of a bundle against a box of the other tree.   returns those in reach
  unsigned open(const Tree& tree, int bundle, const Tree& other, int box, const Move<Real>& move,
                const Triple<Real>& along, Real sense, Real* bounds) const {
    const BoxBundle& from = tree.boxes(bundle);
    const BoxOf<F> eight = load_boxes<F>(from);
    const BoxOf<Real> one = moved(load_box<Real>(other.boxes(box / 8), box % 8), move);
    unsigned used = 0;
    for (int lane = 0; lane < 8; ++lane) used |= (from.child[lane] >= 0 ? 1u : 0u) << lane;
    if (guided_) {
      // from the eight to the one, or the other way
      const Real one_near = dot(one.centre, along) - sense * shadow(one, along);
      const F eight_near = dot(eight.centre, along) + shadow(eight, along) * sense;
      const F gap = (eight_near - one_near) * -sense;
      used &= ~(gap > limit_).set();
      if (!used) return 0;
    }
    const F gaps = box_gaps(eight, one);
    gaps.store(bounds);
    return used & ~(gaps > limit_).set();
  }

  // corners of b's leaf in the frame of a, and the bounds along the axes
  struct Extents {
    Triple<F> low, high;
  };
  static CLENCH_INLINE Extents extents(const TrianglesOf<F>& t) {
    const auto &p = t.corner[0], &q = t.corner[1], &r = t.corner[2];
    return {{min(min(p.x, q.x), r.x), min(min(p.y, q.y), r.y), min(min(p.z, q.z), r.z)},
            {max(max(p.x, q.x), r.x), max(max(p.y, q.y), r.y), max(max(p.z, q.z), r.z)}};
  }

  // The pairs of two leaves, a row of eight for each triangle of a; those in reach by the axes of
  // a's frame and by the known direction.
  struct Rows {
    uint8_t row[8];
    bool any() const {
      uint64_t all;
      std::memcpy(&all, row, sizeof all);
      return all != 0;
    }
    // up to eight of the pairs, taken out
    int take(int32_t* of_a, int32_t* of_b) {
      int count = 0;
      for (int i = 0; i < 8; ++i)
        while (row[i] && count < 8) {
          of_a[count] = i;
          of_b[count] = __builtin_ctz(row[i]);
          row[i] &= static_cast<uint8_t>(row[i] - 1);
          ++count;
        }
      for (int k = count; k < 8; ++k) of_a[k] = of_b[k] = 0;
      return count;
    }
  };

  static unsigned used(const TriangleBundle& leaf) {
    unsigned out = 0;
    for (int lane = 0; lane < 8; ++lane) out |= (leaf.triangle[lane] >= 0 ? 1u : 0u) << lane;
    return out;
  }

  // drops what is out of reach
  void sift(const TrianglesOf<F>& a, const TrianglesOf<F>& b, Rows& rows) const {
    const Extents box_a = extents(a), box_b = extents(b);
    Real low[3][8], high[3][8], top[8] = {};
    box_a.low.x.store(low[0]), box_a.low.y.store(low[1]), box_a.low.z.store(low[2]);
    box_a.high.x.store(high[0]), box_a.high.y.store(high[1]), box_a.high.z.store(high[2]);
    F bottom = F::all(0);
    if (guided_) {
      const auto &p = a.corner, &q = b.corner;
      max(max(dot(p[0], along_a_), dot(p[1], along_a_)), dot(p[2], along_a_)).store(top);
      bottom = min(min(dot(q[0], along_a_), dot(q[1], along_a_)), dot(q[2], along_a_));
    }
    const F zero = F::all(0);
    for (int i = 0; i < 8; ++i) {
      if (!rows.row[i]) continue;
      // how far box b lies beyond either side of box a
      const F x = max(max(box_b.low.x - high[0][i], F::all(low[0][i]) - box_b.high.x), zero);
      const F y = max(max(box_b.low.y - high[1][i], F::all(low[1][i]) - box_b.high.y), zero);
      const F z = max(max(box_b.low.z - high[2][i], F::all(low[2][i]) - box_b.high.z), zero);
      auto far = (x * x + y * y + z * z) > squared_limit_;
      if (guided_) far = far | (bottom - top[i] > limit_);
      rows.row[i] &= static_cast<uint8_t>(~far.set());
    }
  }

  Rows all_pairs(const TriangleBundle& a, const TriangleBundle& b) const {
    Rows rows;
    const unsigned lanes_a = used(a), lanes_b = used(b);
    for (int i = 0; i < 8; ++i) rows.row[i] = static_cast<uint8_t>(lanes_a >> i & 1 ? lanes_b : 0);
    return rows;
  }

  bool near_leaves(int leaf_a, int leaf_b, PairVisit visit) {
    const TriangleBundle &from_a = a_.leaf(leaf_a), &from_b = b_.leaf(leaf_b);
    Rows rows = all_pairs(from_a, from_b);
    // with no limit any pair will do to give one
    if (!(limit_ < std::numeric_limits<Real>::infinity())) {
      rows.row[0] &= static_cast<uint8_t>(~1u);
      if (visit(from_a.triangle[0], from_b.triangle[0])) return true;
      take_reach();
    }
    const TrianglesOf<F> a = load_triangles<F>(from_a),
                         b = moved(load_triangles<F>(from_b), b_to_a_);
    sift(a, b, rows);
    alignas(32) int32_t of_a[8], of_b[8];
    while (rows.any()) {
      const int count = rows.take(of_a, of_b);
      Real bounds[8];
      nearest_bounds(pick(a, of_a), pick(b, of_b)).store(bounds);
      const Real before = limit_;
      // nearest first; what is not a number counts as near
      for (unsigned left = (1u << count) - 1; left;) {
        int best = __builtin_ctz(left);
        for (unsigned rest = left & (left - 1); rest; rest &= rest - 1) {
          const int k = __builtin_ctz(rest);
          if (!(bounds[k] >= bounds[best])) best = k;
        }
        left &= ~(1u << best);
        if (bounds[best] > limit_) continue;
        if (visit(from_a.triangle[of_a[best]], from_b.triangle[of_b[best]])) return true;
        take_reach();
      }
      if (limit_ < before && rows.any()) sift(a, b, rows);
    }
    return false;
  }

  bool meeting_leaves(int leaf_a, int leaf_b, PairVisit visit) {
    const TriangleBundle &from_a = a_.leaf(leaf_a), &from_b = b_.leaf(leaf_b);
    const TrianglesOf<F> a = load_triangles<F>(from_a),
                         b = moved(load_triangles<F>(from_b), b_to_a_);
    Rows rows = all_pairs(from_a, from_b);
    sift(a, b, rows);
    alignas(32) int32_t of_a[8], of_b[8];
    while (rows.any()) {
      const int count = rows.take(of_a, of_b);
      unsigned left = may_meet(pick(a, of_a), pick(b, of_b), slack_, (1u << count) - 1);
      for (; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        if (visit(from_a.triangle[of_a[k]], from_b.triangle[of_b[k]])) return true;
      }
    }
    return false;
  }

  const Tree &a_, &b_;
  const Move<Real> b_to_a_, a_to_b_;
  const Real slack_;
  const Reach* reach_ = nullptr;
  Real limit_ = 0, squared_limit_ = 0;
  bool guided_ = false;
  Triple<Real> along_a_{}, along_b_{};
};

// no coordinate of either tree, in the frame of a, is larger
double extent_of(const TreePair& pair) {
  const double* o = pair.offset;
  return std::sqrt(o[0] * o[0] + o[1] * o[1] + o[2] * o[2]) + pair.a->radius() + pair.b->radius();
}

template <class Walk>
bool in_precision(const TreePair& pair, Walk&& walk) {
  const double extent = extent_of(pair);
  if (single_is_enough(extent, pair.a->radius() + pair.b->radius())) {
    PairWalk<FloatLanes> single(pair, extent);
    return walk(single);
  }
  PairWalk<DoubleLanes> twofold(pair, extent);
  return walk(twofold);
}

}  // namespace

bool for_near_pairs(const TreePair& pair, const Reach& reach, PairVisit visit) {
  return in_precision(pair, [&](auto& walk) { return walk.near(reach, visit); });
}

bool for_meeting_pairs(const TreePair& pair, PairVisit visit) {
  return in_precision(pair, [&](auto& walk) { return walk.meeting(visit); });
}

}  // namespace clench
