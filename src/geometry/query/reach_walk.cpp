#include <algorithm>
#include <cmath>
#include <vector>

#include "clench/base/watched.h"
#include "clench/geometry/tree/frame_boxes.h"
#include "clench/geometry/tree/precision.h"
#include "clench/geometry/tree/tree_pair.h"
#include "clench/geometry/tree/waiting_pairs.h"

namespace clench {

// Traversals whose reach is known from the start: which triangles may intersect, or be within a
// threshold. All candidates are tested exactly, so neither the order of traversal nor the rounding
// of bounds affects an answer: the compiler may contract products and sums in this file.
namespace {

// If one intersecting pair is sufficient, this many are processed as soon as a leaf is done.
constexpr int reach_patience = 3;

constexpr uint32_t reach_tasks_between_checks = 4096;

// ordered: largest overlap first
template <class F, bool ordered>
class ReachWalk {
  using Real = typename F::Real;

 public:
  ReachWalk(const TreePair& pair, double extent, double reach)
      : a_(*pair.a),
        b_(*pair.b),
        b_to_a_(move_of<Real>(pair)),
        boxes_a_(a_, b_to_a_),
        boxes_b_(b_, b_to_a_),
        limit_(at_least<Real>(reach) +
               slack_of<Real>(extent, a_.radius() + b_.radius(), pair.rounding)) {
    constexpr Real up = 1 + 4 * std::numeric_limits<Real>::epsilon();
    squared_limit_ = limit_ * limit_ * up;
  }

  // depth first
  bool run(PairVisit visit) {
    if (!(limit_ >= 0)) return false;
    int height = 0;
    stack_[height++] = {0, 0, 0, root(a_), root(b_), size_of(a_, 0, 0), size_of(b_, 0, 0)};
    StopCheck check(reach_tasks_between_checks);
    while (height > 0) {
      check();
      const Task task = stack_[--height];
      if ((task.child_a & task.child_b & 1) != 0) {
        if (judge_leaves(task, visit)) return true;
      } else {
        height = open(task, height);
      }
    }
    return judge(visit);
  }

 private:
  // boxes are identified by eight times their bundle plus their lane; leaves have no size, so that
  // the larger one is always opened
  struct Task {
    Real gap;
    int32_t box_a, box_b, child_a, child_b;
    float size_a, size_b;
  };

  static int32_t root(const Tree& tree) { return tree.boxes(0).child[0]; }
  static float size_of(const Tree& tree, int bundle, int lane) {
    const BoxBundle& from = tree.boxes(bundle);
    return from.child[lane] & 1 ? -1 : from.size[lane];
  }

  // Pushes the children within reach onto the stack.
  // returns  its new height
  CLENCH_INLINE int open(const Task& task, int height) {
    const bool opens_a = task.size_a >= task.size_b;
    const int bundle = (opens_a ? task.child_a : task.child_b) >> 1;
    const BoxBundle& from = opens_a ? a_.boxes(bundle) : b_.boxes(bundle);
    const auto rows_a = boxes_a_(opens_a ? bundle : task.box_a >> 3);
    const auto rows_b = boxes_b_(opens_a ? task.box_b >> 3 : bundle);
    const BoxOf<F> eight = eight_of<F>(opens_a ? rows_a : rows_b);
    const BoxOf<Real> one =
        one_of<Real>(opens_a ? rows_b : rows_a, (opens_a ? task.box_b : task.box_a) & 7);
    const F gaps = axis_gaps(eight, one);
    unsigned near = used_lanes(from.child) & ~(gaps > limit_).set();
    if (!near) return height;
    // these separate pairs near an edge that the faces do not
    near &= ~(edge_gaps(eight, one) > limit_).set();
    Real values[8];
    gaps.store(values);
    for (const int first = height; near; near &= near - 1) {
      const int lane = __builtin_ctz(near);
      Task next = task;
      const int32_t child = from.child[lane];
      next.gap = values[lane];
      (opens_a ? next.box_a : next.box_b) = 8 * bundle + lane;
      (opens_a ? next.child_a : next.child_b) = child;
      (opens_a ? next.size_a : next.size_b) = child & 1 ? -1 : from.size[lane];
      int at = height++;
      if constexpr (ordered)
        for (; at > first && stack_[at - 1].gap < next.gap; --at) stack_[at] = stack_[at - 1];
      stack_[at] = next;
    }
    return height;
  }

  // The triangles of a leaf in the frame of a: their bounds along the axes, and their planes, unit
  // normal and offsets between which the corners lie.
  struct Side {
    int leaf = -1;
    Real corners[9][8];
    Real low[3][8], high[3][8];
    Real normal[3][8], above[8], below[8];
  };

  static CLENCH_INLINE void take(const TrianglesOf<F>& t, Side& side) {
    const auto &p = t.corner[0], &q = t.corner[1], &r = t.corner[2];
    min(min(p.x, q.x), r.x).store(side.low[0]), max(max(p.x, q.x), r.x).store(side.high[0]);
    min(min(p.y, q.y), r.y).store(side.low[1]), max(max(p.y, q.y), r.y).store(side.high[1]);
    min(min(p.z, q.z), r.z).store(side.low[2]), max(max(p.z, q.z), r.z).store(side.high[2]);
    for (int k = 0; k < 3; ++k) {
      t.corner[k].x.store(side.corners[3 * k]);
      t.corner[k].y.store(side.corners[3 * k + 1]);
      t.corner[k].z.store(side.corners[3 * k + 2]);
    }
    // no plane if the area is negligible
    Triple<F> n = cross(q - p, r - p);
    const F squared = dot(n, n), zero = F::all(0);
    constexpr Real least = std::numeric_limits<Real>::min() * Real{0x1p30};
    n = n.scaled(select(squared > least, F::all(1) / sqrt(squared), zero));
    const F at_p = dot(p, n), at_q = dot(q, n), at_r = dot(r, n);
    n.x.store(side.normal[0]), n.y.store(side.normal[1]), n.z.store(side.normal[2]);
    max(max(at_p, at_q), at_r).store(side.above), min(min(at_p, at_q), at_r).store(side.below);
  }
  void load_side_a(int leaf) {
    if (leaf == side_a_.leaf) return;
    side_a_.leaf = leaf;
    take(load_triangles<F>(a_.leaf(leaf)), side_a_);
  }
  void load_side_b(int leaf) {
    if (leaf == side_b_.leaf) return;
    side_b_.leaf = leaf;
    take(moved(load_triangles<F>(b_.leaf(leaf)), b_to_a_), side_b_);
  }

  static CLENCH_INLINE Triple<F> eight(const Real (&rows)[9][8], int corner) {
    return {F::stored(rows[3 * corner]), F::stored(rows[3 * corner + 1]),
            F::stored(rows[3 * corner + 2])};
  }
  static CLENCH_INLINE Triple<F> eight(const Real (&rows)[3][8]) {
    return {F::stored(rows[0]), F::stored(rows[1]), F::stored(rows[2])};
  }

  // which triangles of a side are in reach of a box of the other, by its axes and their own planes
  CLENCH_INLINE unsigned near_box(const Side& side, const BoxOf<Real>& box) const {
    const Triple<F> n = eight(side.normal);
    const F at = dot(n, box.center);
    F reach = F::all(0);
    for (int k = 0; k < 3; ++k) reach = reach + abs(dot(n, box.axis[k])) * box.half[k];
    auto off = (at - reach - F::stored(side.above) > limit_) |
               (F::stored(side.below) - at - reach > limit_);
    for (int k = 0; k < 3; ++k) {
      F s[3];
      for (int c = 0; c < 3; ++c) s[c] = dot(eight(side.corners, c), box.axis[k]);
      const Real middle = dot(box.center, box.axis[k]), far = box.half[k] + limit_;
      off = off | (min(min(s[0], s[1]), s[2]) > middle + far) |
            (max(max(s[0], s[1]), s[2]) < middle - far);
    }
    return ~off.set();
  }

  static CLENCH_INLINE Triple<Real> one(const Real (&rows)[9][8], int corner, int lane) {
    return {rows[3 * corner][lane], rows[3 * corner + 1][lane], rows[3 * corner + 2][lane]};
  }

  // which of b's triangles are in reach of triangle i of a, by the axes of a's frame and the planes
  // of both
  CLENCH_INLINE unsigned near_row(int i, unsigned expected) const {
    const Side &a = side_a_, &b = side_b_;
    F squared = F::all(0);
    for (int m = 0; m < 3; ++m) {
      // how far b lies beyond either side of a
      const F apart =
          max(max(F::stored(b.low[m]) - a.high[m][i], F::all(a.low[m][i]) - F::stored(b.high[m])),
              F::all(0));
      squared = squared + apart * apart;
    }
    expected &= ~(squared > squared_limit_).set();
    if (!expected) return 0;
    const Triple<Real> n = {a.normal[0][i], a.normal[1][i], a.normal[2][i]};
    F s[3];
    for (int k = 0; k < 3; ++k) s[k] = dot(eight(b.corners, k), n);
    const auto off_a = (min(min(s[0], s[1]), s[2]) > a.above[i] + limit_) |
                       (max(max(s[0], s[1]), s[2]) < a.below[i] - limit_);
    for (int k = 0; k < 3; ++k) s[k] = dot(eight(b.normal), one(a.corners, k, i));
    const auto off_b = (min(min(s[0], s[1]), s[2]) - F::stored(b.above) > limit_) |
                       (max(max(s[0], s[1]), s[2]) - F::stored(b.below) < -limit_);
    return expected & ~(off_a | off_b).set();
  }

  // Pairs of two leaves within reach are collected and processed together.
  bool judge_leaves(const Task& task, PairVisit visit) {
    const int leaf_a = task.child_a >> 1, leaf_b = task.child_b >> 1;
    const TriangleBundle &from_a = a_.leaf(leaf_a), &from_b = b_.leaf(leaf_b);
    load_side_a(leaf_a);
    unsigned lanes_a = used_lanes(from_a.triangle) &
                       near_box(side_a_, one_of<Real>(boxes_b_(task.box_b >> 3), task.box_b & 7));
    if (!lanes_a) return false;
    load_side_b(leaf_b);
    const unsigned lanes_b =
        used_lanes(from_b.triangle) &
        near_box(side_b_, one_of<Real>(boxes_a_(task.box_a >> 3), task.box_a & 7));
    if (!lanes_b) return false;
    for (; lanes_a; lanes_a &= lanes_a - 1) {
      const int i = __builtin_ctz(lanes_a);
      for (unsigned row = near_row(i, lanes_b); row; row &= row - 1) {
        const int j = __builtin_ctz(row);
        waiting_.add(side_a_.corners, i, side_b_.corners, j,
                     {from_a.triangle[i], from_b.triangle[j]});
        if (waiting_.full() && judge(visit)) return true;
      }
    }
    if constexpr (ordered)
      if (waiting_.count() >= reach_patience) return judge(visit);
    return false;
  }

  // Tests the collected pairs.
  // returns  true if the traversal ends
  bool judge(PairVisit visit) {
    return waiting_.take(
        [&](const TrianglesOf<F>& a, const TrianglesOf<F>& b, unsigned all, const NearPair* pairs) {
          for (unsigned left = edges_within_reach(a, b, limit_, all); left; left &= left - 1) {
            const NearPair& pair = pairs[__builtin_ctz(left)];
            if (visit(pair.triangle_a, pair.triangle_b)) return true;
          }
          return false;
        });
  }

  const Tree &a_, &b_;
  const Move<Real> b_to_a_;
  FrameBoxes<F, false> boxes_a_;
  FrameBoxes<F, true> boxes_b_;
  const Real limit_;
  Real squared_limit_;
  Task stack_[16 * deepest_tree];
  Side side_a_, side_b_;
  WaitingPairs<F> waiting_;
};

template <bool ordered>
bool visit_within(const TreePair& pair, double reach, PairVisit visit) {
  const double extent = extent_of(pair);
  if (single_is_enough(extent, pair.a->radius() + pair.b->radius()))
    return ReachWalk<FloatLanes, ordered>(pair, extent, reach).run(visit);
  return ReachWalk<DoubleLanes, ordered>(pair, extent, reach).run(visit);
}

}  // namespace

void find_pairs_within(const TreePair& pair, double reach, std::vector<NearPair>& out) {
  visit_within<false>(pair, reach, [&](int triangle_a, int triangle_b) {
    out.push_back({triangle_a, triangle_b});
    return false;
  });
}

bool for_meeting_pairs(const TreePair& pair, PairVisit visit) {
  return visit_within<true>(pair, 0, visit);
}

}  // namespace clench
