// One box, point or ray against eight boxes at once. For the queries of this module only.
//
// Bounds are lower bounds of distances up to the slack of the query, which the caller subtracts. In
// single precision, u = 2^-24, lengths at most l (the query's extent): a center transformed to the
// other frame has an error of 5 u l per coordinate, its difference along an axis 14 u l, the
// projection of a box 16 u l for the rounding of the product of the frames and 8 u l because stored
// axes are orthonormal only up to 2 u, and the root of the sum of squares 4 u l: 42 u l in all, 64
// u l are used. In double precision stored axes are orthonormalized, and the boxes enlarged by the
// difference.
#pragma once
#include "clench/geometry/tree/lanes.h"
#include "clench/geometry/tree/tree.h"

namespace clench {

/// Boxes: a single one (F a number), or one per lane.
template <class F>
struct BoxOf {
  Triple<F> axis[3];
  Triple<F> center;
  F half[3];
};

// zero for single precision: the slack covers it
template <class F>
CLENCH_INLINE void straighten(BoxOf<F>& box, const F& grow) {
  const F first = sqrt(dot(box.axis[0], box.axis[0]));
  box.axis[0] = {box.axis[0].x / first, box.axis[0].y / first, box.axis[0].z / first};
  box.axis[1] = box.axis[1] - box.axis[0].scaled(dot(box.axis[1], box.axis[0]));
  const F second = sqrt(dot(box.axis[1], box.axis[1]));
  box.axis[1] = {box.axis[1].x / second, box.axis[1].y / second, box.axis[1].z / second};
  box.axis[2] = cross(box.axis[0], box.axis[1]);
  for (F& half : box.half) half = half + grow;
}
// distance of a box's corners outside of it after its axes are orthonormalized, relative to its
// size
inline constexpr double straightened = 0x1p-20;

template <class F>
CLENCH_INLINE BoxOf<F> load_boxes(const BoxBundle& from) {
  BoxOf<F> out;
  for (int k = 0; k < 3; ++k) {
    out.axis[k] = {F::load(from.axes[3 * k]), F::load(from.axes[3 * k + 1]),
                   F::load(from.axes[3 * k + 2])};
    out.half[k] = F::load(from.half[k]);
  }
  out.center = {F::load(from.center[0]), F::load(from.center[1]), F::load(from.center[2])};
  if constexpr (sizeof(typename F::Real) == 8) straighten(out, F::load(from.size) * straightened);
  return out;
}

template <class F, class Real>
CLENCH_INLINE BoxOf<F> moved(const BoxOf<F>& boxes, const Move<Real>& move) {
  return {{move.turned(boxes.axis[0]), move.turned(boxes.axis[1]), move.turned(boxes.axis[2])},
          move(boxes.center),
          {boxes.half[0], boxes.half[1], boxes.half[2]}};
}

/// Half extents of the boxes along n.
template <class F, class N>
CLENCH_INLINE F shadow(const BoxOf<F>& box, const Triple<N>& n) {
  using std::abs;
  return abs(dot(box.axis[0], n)) * box.half[0] + abs(dot(box.axis[1], n)) * box.half[1] +
         abs(dot(box.axis[2], n)) * box.half[2];
}

/// Lower bounds of the distances of one box from eight, by the axes of both; negative, the smallest
/// depth along these axes, if all of them show an overlap.
template <class F>
CLENCH_INLINE F box_gaps(const BoxOf<F>& eight, const BoxOf<typename F::Real>& one) {
  using Real = typename F::Real;
  const Triple<F> between = {eight.center.x - one.center.x, eight.center.y - one.center.y,
                             eight.center.z - one.center.z};
  const F zero = F::all(0);
  // along[j]: components of the eight along axis j of the one
  F along[3] = {zero, zero, zero};
  F squared_eight = zero, squared_one = zero,
    min_deep = F::all(std::numeric_limits<Real>::lowest());
  for (int k = 0; k < 3; ++k) {
    F reach = eight.half[k];
    for (int j = 0; j < 3; ++j) {
      const F turn = abs(dot(eight.axis[k], one.axis[j]));
      reach = reach + turn * one.half[j];
      along[j] = along[j] + turn * eight.half[k];
    }
    const F gap = abs(dot(eight.axis[k], between)) - reach;
    min_deep = max(gap, min_deep);
    const F apart = max(gap, zero);
    squared_eight = squared_eight + apart * apart;
  }
  for (int j = 0; j < 3; ++j) {
    const F gap = abs(dot(between, one.axis[j])) - along[j] - one.half[j];
    min_deep = max(gap, min_deep);
    const F apart = max(gap, zero);
    squared_one = squared_one + apart * apart;
  }
  const F squared = max(squared_eight, squared_one);
  return select(squared > Real{0}, sqrt(squared), min_deep);
}

/// The largest gap along any axis of the two, or the smallest depth if all of them show an overlap:
/// also a lower bound of the distance, less tight than box_gaps, and cheaper.
template <class F>
CLENCH_INLINE F axis_gaps(const BoxOf<F>& eight, const BoxOf<typename F::Real>& one) {
  const Triple<F> between = {eight.center.x - one.center.x, eight.center.y - one.center.y,
                             eight.center.z - one.center.z};
  F along[3], most;
  for (int k = 0; k < 3; ++k) {
    F reach = eight.half[k];
    for (int j = 0; j < 3; ++j) {
      const F turn = abs(dot(eight.axis[k], one.axis[j]));
      reach = reach + turn * one.half[j];
      along[j] = k == 0 ? turn * eight.half[0] : along[j] + turn * eight.half[k];
    }
    const F gap = abs(dot(eight.axis[k], between)) - reach;
    most = k == 0 ? gap : max(gap, most);
  }
  for (int j = 0; j < 3; ++j)
    most = max(abs(dot(between, one.axis[j])) - along[j] - one.half[j], most);
  return most;
}

/// The largest gap along the products of their axes, of length at most 1; 0 for none: also a lower
/// bound. Its rounding, counted as above: 37 u l of the products, 17 u l of the projections, 8 u l
/// of the axes.
template <class F>
CLENCH_INLINE F edge_gaps(const BoxOf<F>& eight, const BoxOf<typename F::Real>& one) {
  const Triple<F> between = {eight.center.x - one.center.x, eight.center.y - one.center.y,
                             eight.center.z - one.center.z};
  F turn[3][3], shadow[3][3], offset[3];
  for (int k = 0; k < 3; ++k) {
    offset[k] = dot(eight.axis[k], between);
    for (int j = 0; j < 3; ++j) {
      turn[k][j] = dot(eight.axis[k], one.axis[j]);
      shadow[k][j] = abs(turn[k][j]);
    }
  }
  F most = F::all(0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const F reach = eight.half[i1] * shadow[i2][j] + eight.half[i2] * shadow[i1][j] +
                      shadow[i][j2] * one.half[j1] + shadow[i][j1] * one.half[j2];
      most = max(abs(offset[i2] * turn[i1][j] - offset[i1] * turn[i2][j]) - reach, most);
    }
  return most;
}

/// Squares of the distances of a point from eight boxes; 0 inside.
template <class F>
CLENCH_INLINE F squared_point_gaps(const BoxOf<F>& eight, const Triple<typename F::Real>& p) {
  const Triple<F> between = {eight.center.x - p.x, eight.center.y - p.y, eight.center.z - p.z};
  F squared = F::all(0);
  for (int k = 0; k < 3; ++k) {
    const F apart = max(abs(dot(eight.axis[k], between)) - eight.half[k], F::all(0));
    squared = squared + apart * apart;
  }
  return squared;
}

}  // namespace clench
