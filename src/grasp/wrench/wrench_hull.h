// Convex hull of wrenches, for any set of them: symmetric grasps repeat wrenches up to rounding,
// and qhull rejects some such sets.
#pragma once
#include "clench/geometry/mesh/hull.h"

namespace clench {

/// Hull of six-dimensional points of size about one. Points nearer to an earlier one than 1e-12 are
/// omitted (no facet refers to them). If qhull fails nevertheless, all points are shifted by fixed
/// pseudo-random displacements of at most 1e-11, then 1e-9, and so on; offsets are accurate to
/// that.
///
/// points  6 x count, finite, largest coordinate about 1
Hull wrench_hull(const Eigen::MatrixXd& points);

}  // namespace clench
