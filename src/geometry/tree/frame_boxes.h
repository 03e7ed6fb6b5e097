// The boxes of a tree in the frame of a query: a bundle is transformed on first use and cached, as
// a query returns to most of them. For the traversals only.
#pragma once
#include <cstddef>

#include "clench/geometry/tree/box_lanes.h"

namespace clench {

/// Eight boxes by rows of eight numbers: nine of axes, three of centers, three of half extents.
template <class Real>
using BoxRows = const Real*;

inline constexpr int box_rows = 15;

template <class F>
CLENCH_INLINE BoxOf<F> eight_of(BoxRows<typename F::Real> rows) {
  const auto row = [&](int i) { return F::stored(rows + 8 * i); };
  const auto triple = [&](int i) { return Triple<F>{row(i), row(i + 1), row(i + 2)}; };
  return {{triple(0), triple(3), triple(6)}, triple(9), {row(12), row(13), row(14)}};
}

template <class Real>
CLENCH_INLINE BoxOf<Real> one_of(BoxRows<Real> rows, int lane) {
  const auto triple = [&](int row) {
    return Triple<Real>{rows[8 * row + lane], rows[8 * row + 8 + lane], rows[8 * row + 16 + lane]};
  };
  return {{triple(0), triple(3), triple(6)},
          triple(9),
          {rows[8 * 12 + lane], rows[8 * 13 + lane], rows[8 * 14 + lane]}};
}

/// Transformed: to the frame of the other tree; otherwise about the tree's own center.
template <class F, bool Moved>
class FrameBoxes {
  using Real = typename F::Real;
  static constexpr bool as_stored = !Moved && sizeof(Real) == sizeof(float);
  static constexpr int kept = as_stored ? 1 : 32;

 public:
  CLENCH_INLINE FrameBoxes(const Tree& tree, const Move<Real>& move) : tree_(tree), move_(move) {
    for (int& number : numbers_) number = -1;
  }

  /// valid until the next call
  CLENCH_INLINE BoxRows<Real> operator()(int bundle) {
    if constexpr (as_stored) {
      static_assert(offsetof(BoxBundle, center) == 9 * 8 * sizeof(float) &&
                    offsetof(BoxBundle, half) == 12 * 8 * sizeof(float));
      return reinterpret_cast<const float*>(&tree_.boxes(bundle));
    } else {
      const int slot = bundle % kept;
      if (numbers_[slot] != bundle) fetch(bundle, slot);
      return rows_[slot];
    }
  }

 private:
  CLENCH_INLINE void fetch(int bundle, int slot) {
    numbers_[slot] = bundle;
    BoxOf<F> eight = load_boxes<F>(tree_.boxes(bundle));
    if constexpr (Moved) eight = moved(eight, move_);
    Real* to = rows_[slot];
    const auto keep = [&](const F& row) { row.store(to), to += 8; };
    for (const Triple<F>& axis : eight.axis) keep(axis.x), keep(axis.y), keep(axis.z);
    keep(eight.center.x), keep(eight.center.y), keep(eight.center.z);
    for (const F& half : eight.half) keep(half);
  }

  const Tree& tree_;
  const Move<Real> move_;
  int numbers_[kept];
  alignas(64) Real rows_[kept][8 * box_rows];
};

}  // namespace clench
