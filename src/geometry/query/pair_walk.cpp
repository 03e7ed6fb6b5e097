#include <cmath>
#include <limits>
#include <vector>

#include "clench/base/watched.h"
#include "clench/geometry/tree/box_lanes.h"
#include "clench/geometry/tree/frame_boxes.h"
#include "clench/geometry/tree/precision.h"
#include "clench/geometry/tree/tree_pair.h"
#include "clench/geometry/tree/waiting_pairs.h"

namespace clench {

namespace {

// number of pairs processed at once after a leaf: fewer would leave lanes idle, more would delay
// the lowering of the limit
constexpr int patience = 4;

constexpr uint32_t tasks_between_checks = 4096;

template <class F>
class PairWalk {
  using Real = typename F::Real;

 public:
  PairWalk(const TreePair& pair, double extent)
      : a_(*pair.a),
        b_(*pair.b),
        b_to_a_(move_of<Real>(pair)),
        boxes_a_(a_, b_to_a_),
        boxes_b_(b_, b_to_a_),
        slack_(slack_of<Real>(extent, a_.radius() + b_.radius(), pair.rounding)) {}

  bool nearest(const Reach& reach, std::vector<NearPair>& out, PairVisit meet) {
    limit_to(at_least<Real>(reach.distance) + slack_);
    const double *n = reach.along, length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length > 1e-150)
      guide({static_cast<Real>(n[0] / length), static_cast<Real>(n[1] / length),
             static_cast<Real>(n[2] / length)});
    if (run(meet)) return true;
    for (const Found& found : found_)
      if (!(found.low > limit_)) out.push_back(found.pair);
    return false;
  }

  DistanceBound bound(const Reach& reach, double part, double nearest, PairVisit meet) {
    part_ = static_cast<Real>(part);
    best_ = static_cast<Real>(nearest);
    limit_to(at_least<Real>(reach.distance) + slack_);
    if (run(meet)) return {};
    Real low = limit_;
    for (const Found& found : found_) low = std::min(low, found.low);
    return {static_cast<double>(low) - 2 * static_cast<double>(slack_), nearest_};
  }

 private:
  // boxes are identified by eight times their bundle plus their lane
  struct Task {
    Real bound;
    int32_t box_a, box_b;
  };

  static int child(const Tree& tree, int box) { return tree.boxes(box / 8).child[box % 8]; }
  static Real size(const Tree& tree, int box) { return tree.boxes(box / 8).size[box % 8]; }

  // bounds beyond the limit are dropped
  void limit_to(Real limit) {
    limit_ = limit;
    constexpr Real up = 1 + 4 * std::numeric_limits<Real>::epsilon();
    squared_limit_ = limit < 0 ? Real{-1} : limit * limit * up;
  }
  // n, unit, is an estimate of the direction from a to b at their nearest points
  void guide(const Triple<Real>& n) {
    guided_ = true;
    along_ = n;
    side_a_.leaf = side_b_.leaf = -1;
  }

  bool run(PairVisit visit) {
    Task stack[16 * deepest_tree];
    int height = 0;
    stack[height++] = {std::numeric_limits<Real>::lowest(), 0, 0};
    StopCheck check(tasks_between_checks);
    while (height > 0) {
      const Task task = stack[--height];
      if (task.bound > limit_) continue;
      check();
      const int child_a = child(a_, task.box_a), child_b = child(b_, task.box_b);
      const bool leaf_a = child_a & 1, leaf_b = child_b & 1;
      if (leaf_a && leaf_b) {
        if (judge_leaves(child_a >> 1, child_b >> 1, visit)) return true;
        continue;
      }
      // opens the larger box
      const bool open_a = !leaf_a && (leaf_b || size(a_, task.box_a) >= size(b_, task.box_b));
      const int below = (open_a ? child_a : child_b) >> 1;
      Real bounds[8];
      unsigned near = open(open_a, below, open_a ? task.box_b : task.box_a, bounds);
      // the nearest one on top of the stack
      for (const int first = height; near; near &= near - 1) {
        const int lane = __builtin_ctz(near), box = 8 * below + lane;
        const Task next{bounds[lane], open_a ? box : task.box_a, open_a ? task.box_b : box};
        int at = height++;
        for (; at > first && stack[at - 1].bound < next.bound; --at) stack[at] = stack[at - 1];
        stack[at] = next;
      }
    }
    return judge(visit);
  }

  // Bounds of the eight boxes of a bundle of one tree against a box of the other.
  // returns those within reach
  unsigned open(bool open_a, int bundle, int box, Real* bounds) {
    const BoxBundle& from = open_a ? a_.boxes(bundle) : b_.boxes(bundle);
    const auto rows_a = boxes_a_(open_a ? bundle : box / 8);
    const auto rows_b = boxes_b_(open_a ? box / 8 : bundle);
    const BoxOf<F> eight = eight_of<F>(open_a ? rows_a : rows_b);
    const BoxOf<Real> one = one_of<Real>(open_a ? rows_b : rows_a, box % 8);
    unsigned used = used_lanes(from.child);
    if (guided_) {
      // from the eight to the one, or the opposite
      const Real sense = open_a ? 1 : -1;
      const Real one_near = dot(one.center, along_) - sense * shadow(one, along_);
      const F eight_near = dot(eight.center, along_) + shadow(eight, along_) * sense;
      const F gap = (eight_near - one_near) * -sense;
      used &= ~(gap > limit_).set();
      if (!used) return 0;
    }
    // the products of axes would cost more than they save
    const F gaps = box_gaps(eight, one);
    gaps.store(bounds);
    return used & ~(gaps > limit_).set();
  }

  // The triangles of a leaf in the frame of a, their bounds along the axes, and their support along
  // the known direction: upwards for those of a, downwards for those of b. Cached until the leaf
  // changes.
  struct Side {
    int leaf = -1;
    Real corners[9][8];
    Triple<F> low, high;
    F along;
  };

  static CLENCH_INLINE void take(const TrianglesOf<F>& t, Side& side) {
    const auto &p = t.corner[0], &q = t.corner[1], &r = t.corner[2];
    side.low = {min(min(p.x, q.x), r.x), min(min(p.y, q.y), r.y), min(min(p.z, q.z), r.z)};
    side.high = {max(max(p.x, q.x), r.x), max(max(p.y, q.y), r.y), max(max(p.z, q.z), r.z)};
    for (int k = 0; k < 3; ++k) {
      t.corner[k].x.store(side.corners[3 * k]);
      t.corner[k].y.store(side.corners[3 * k + 1]);
      t.corner[k].z.store(side.corners[3 * k + 2]);
    }
  }
  void load_sides(int leaf_a, int leaf_b) {
    if (leaf_a != side_a_.leaf) {
      side_a_.leaf = leaf_a;
      const TrianglesOf<F> t = load_triangles<F>(a_.leaf(leaf_a));
      take(t, side_a_);
      const auto& p = t.corner;
      if (guided_)
        side_a_.along = max(max(dot(p[0], along_), dot(p[1], along_)), dot(p[2], along_));
    }
    if (leaf_b != side_b_.leaf) {
      side_b_.leaf = leaf_b;
      const TrianglesOf<F> t = moved(load_triangles<F>(b_.leaf(leaf_b)), b_to_a_);
      take(t, side_b_);
      const auto& p = t.corner;
      if (guided_)
        side_b_.along = min(min(dot(p[0], along_), dot(p[1], along_)), dot(p[2], along_));
    }
  }

  // The pairs of two leaves, a row of eight for each triangle of a; those within reach by the axes
  // of a's frame and by the known direction.
  struct Rows {
    uint8_t row[8];
  };

  // drops what is out of reach
  void sift(Rows& rows) const {
    const Side &a = side_a_, &b = side_b_;
    Real low[3][8], high[3][8], top[8] = {};
    a.low.x.store(low[0]), a.low.y.store(low[1]), a.low.z.store(low[2]);
    a.high.x.store(high[0]), a.high.y.store(high[1]), a.high.z.store(high[2]);
    if (guided_) a.along.store(top);
    const F zero = F::all(0);
    for (int i = 0; i < 8; ++i) {
      if (!rows.row[i]) continue;
      if (guided_) {
        rows.row[i] &= static_cast<uint8_t>(~(b.along > limit_ + top[i]).set());
        if (!rows.row[i]) continue;
      }
      // distance by which box b lies beyond either side of box a
      const F x = max(max(b.low.x - high[0][i], F::all(low[0][i]) - b.high.x), zero);
      const F y = max(max(b.low.y - high[1][i], F::all(low[1][i]) - b.high.y), zero);
      const F z = max(max(b.low.z - high[2][i], F::all(low[2][i]) - b.high.z), zero);
      rows.row[i] &= static_cast<uint8_t>(~((x * x + y * y + z * z) > squared_limit_).set());
    }
  }

  Rows all_pairs(const TriangleBundle& a, const TriangleBundle& b) const {
    Rows rows;
    const unsigned lanes_a = used_lanes(a.triangle), lanes_b = used_lanes(b.triangle);
    for (int i = 0; i < 8; ++i) rows.row[i] = static_cast<uint8_t>(lanes_a >> i & 1 ? lanes_b : 0);
    return rows;
  }

  // Pairs of two leaves within reach are collected until eight can be processed at once.
  bool judge_leaves(int leaf_a, int leaf_b, PairVisit visit) {
    const TriangleBundle &from_a = a_.leaf(leaf_a), &from_b = b_.leaf(leaf_b);
    load_sides(leaf_a, leaf_b);
    Rows rows = all_pairs(from_a, from_b);
    sift(rows);
    for (int i = 0; i < 8; ++i)
      while (rows.row[i]) {
        const int j = __builtin_ctz(rows.row[i]);
        rows.row[i] &= static_cast<uint8_t>(rows.row[i] - 1);
        waiting_.add(side_a_.corners, i, side_b_.corners, j,
                     {from_a.triangle[i], from_b.triangle[j]});
        if (!waiting_.full()) continue;
        const Real before = limit_;
        if (judge(visit)) return true;
        if (limit_ < before) {
          load_sides(leaf_a, leaf_b);
          sift(rows);
        }
      }
    // pairs that may lower the limit are processed immediately
    return waiting_.count() >= patience && judge(visit);
  }

  // Tests the collected pairs.
  // returns  true if the traversal ends
  bool judge(PairVisit visit) {
    return waiting_.take(
        [&](const TrianglesOf<F>& a, const TrianglesOf<F>& b, unsigned all, const NearPair* pairs) {
          return judge_nearest(a, b, all, pairs, visit);
        });
  }

  bool judge_nearest(const TrianglesOf<F>& a, const TrianglesOf<F>& b, unsigned all,
                     const NearPair* pairs, PairVisit meet) {
    const NearBounds<F> bounds = near_bounds(a, b);
    lower_limit(bounds, all, pairs);
    Real low[8];
    bounds.low.store(low);
    for (unsigned left = all & ~(bounds.low > limit_).set(); left; left &= left - 1) {
      const int k = __builtin_ctz(left);
      const NearPair& pair = pairs[k];
      found_.push_back({low[k], pair});
      if (!(low[k] > slack_) && meet(pair.triangle_a, pair.triangle_b)) return true;
    }
    return false;
  }

  // Lowers the limit to the smallest of the eight distances; its direction guides the search.
  void lower_limit(const NearBounds<F>& bounds, unsigned taken, const NearPair* pairs) {
    Real high[8];
    bounds.high.store(high);
    int best = __builtin_ctz(taken);
    for (unsigned rest = taken; rest; rest &= rest - 1)
      if (high[__builtin_ctz(rest)] < high[best]) best = __builtin_ctz(rest);
    const Real least = part_ * high[best] + 2 * slack_;
    if (!(least < limit_) || !(high[best] < best_)) return;
    best_ = high[best];
    nearest_ = pairs[best];
    limit_to(least);
    Real x[8], y[8], z[8];
    bounds.way.x.store(x), bounds.way.y.store(y), bounds.way.z.store(z);
    if (high[best] > slack_)
      guide({x[best] / high[best], y[best] / high[best], z[best] / high[best]});
  }

  const Tree &a_, &b_;
  const Move<Real> b_to_a_;
  FrameBoxes<F, false> boxes_a_;
  FrameBoxes<F, true> boxes_b_;
  const Real slack_;
  Real limit_ = 0, squared_limit_ = 0;
  // pairs farther than this fraction of the nearest found so far are irrelevant
  Real part_ = 1, best_ = std::numeric_limits<Real>::infinity();
  NearPair nearest_{-1, -1};
  bool guided_ = false;
  Triple<Real> along_{};
  Side side_a_, side_b_;
  struct Found {
    Real low;
    NearPair pair;
  };
  std::vector<Found> found_;
  WaitingPairs<F> waiting_;
};

template <class Walk>
auto in_precision(const TreePair& pair, Walk&& walk) {
  const double extent = extent_of(pair);
  if (single_is_enough(extent, pair.a->radius() + pair.b->radius())) {
    PairWalk<FloatLanes> single(pair, extent);
    return walk(single);
  }
  PairWalk<DoubleLanes> twofold(pair, extent);
  return walk(twofold);
}

}  // namespace

bool find_nearest_pairs(const TreePair& pair, const Reach& reach, std::vector<NearPair>& out,
                        PairVisit meet) {
  return in_precision(pair, [&](auto& walk) { return walk.nearest(reach, out, meet); });
}

DistanceBound bound_distance(const TreePair& pair, const Reach& reach, double part, double nearest,
                             PairVisit meet) {
  return in_precision(pair, [&](auto& walk) { return walk.bound(reach, part, nearest, meet); });
}

}  // namespace clench
