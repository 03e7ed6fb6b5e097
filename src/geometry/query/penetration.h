// Penetration depth of two shapes.
#pragma once
#include "clench/base/progress.h"
#include "clench/geometry/query/queries.h"

namespace clench {

struct PenetrationOptions {
  /// The result is at most absolute + relative * depth below the true depth, both > 0. Overlaps
  /// beyond rounding never have depth 0 because of `absolute` [m]: until a point inside is found,
  /// 1e-5 of the smaller radius is used instead if that is less.
  double absolute = 1e-6, relative = 1e-3;
  /// Maximum number of waiting regions, about 200 bytes each. Beyond it the search is depth-first,
  /// which keeps the tolerance, but takes longer.
  size_t max_regions = 100'000;
  Progress progress = {};
};

struct Penetration {
  double depth = 0;  ///< distance of `point` from the surface of a [m]; 0 without an overlap
  double bound = 0;  ///< upper bound on the depth of all points; at least depth [m]
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< in both, in the frame of a
  int triangle = -1;                                ///< of a, nearest to that point; -1: none
};

/// The largest distance from the surface of a, over the points of b that lie inside a. Points of b
/// are those of its surface and, if it is closed, of its solid; inside is defined as in contains,
/// so that nothing is inside an open mesh. Shapes that only touch have depth 0.
///
/// The result is the depth of an actual point, and at most the tolerance of the options below the
/// true depth.
/// throws  Stopped
///
/// method  Branch and bound over the triangles of b, and over tetrahedra of space for maxima in its
///         interior. The bound on a simplex is the value of a game: the distance from one triangle
///         of a is convex, so any mixture of such distances is largest at a corner.
Penetration penetration(const Shape& a, const Shape& b, const Pose& X_AB,
                        const PenetrationOptions& options = {});

}  // namespace clench
