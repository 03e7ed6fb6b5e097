// One box of a bundle, as used by the tree traversals.
#pragma once
#include <cstring>

#include "clench/geometry/tree/frame_boxes.h"

namespace clench {

template <class Real>
BoxOf<Real> one_box(const BoxBundle& boxes, int lane) {
  const BoxOf<Lanes<Real, 1>> eight = load_boxes<Lanes<Real, 1>>(boxes);
  Real rows[8 * box_rows];
  static_assert(sizeof rows == sizeof eight);
  std::memcpy(rows, &eight, sizeof rows);
  return one_of<Real>(rows, lane);
}

}  // namespace clench
