// Pairs of triangles that are collected until eight can be processed at once. For the traversals
// only.
#pragma once
#include "clench/geometry/tree/triangle_lanes.h"
#include "clench/geometry/tree/walk.h"

namespace clench {

template <class F>
class WaitingPairs {
  using Real = typename F::Real;

 public:
  /// coordinate m of corner k of triangle i at [3 k + m][i]
  using Corners = Real[9][8];

  int count() const { return count_; }
  bool full() const { return count_ == lane_count; }

  /// requires space: not full
  CLENCH_INLINE void add(const Corners& a, int lane_a, const Corners& b, int lane_b,
                         const NearPair& pair) {
    for (int k = 0; k < 9; ++k) {
      a_[k][count_] = a[k][lane_a];
      b_[k][count_] = b[k][lane_b];
    }
    pairs_[count_++] = pair;
  }

  /// Calls judge(a, b, lanes, pairs) for the collected pairs, if there are any, and removes them.
  /// returns  the result of judge
  template <class Judge>
  CLENCH_INLINE bool take(Judge&& judge) {
    const int count = count_;
    if (count == 0) return false;
    count_ = 0;
    // unused lanes repeat the first
    for (int k = 0; k < 9; ++k)
      for (int i = count; i < lane_count; ++i) a_[k][i] = a_[k][0], b_[k][i] = b_[k][0];
    return judge(load(a_), load(b_), (1u << count) - 1, pairs_);
  }

 private:
  static CLENCH_INLINE TrianglesOf<F> load(const Corners& rows) {
    TrianglesOf<F> out;
    for (int k = 0; k < 3; ++k)
      out.corner[k] = {F::stored(rows[3 * k]), F::stored(rows[3 * k + 1]),
                       F::stored(rows[3 * k + 2])};
    return out;
  }

  Corners a_, b_;
  NearPair pairs_[lane_count];
  int count_ = 0;
};

}  // namespace clench
