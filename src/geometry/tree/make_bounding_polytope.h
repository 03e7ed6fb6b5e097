// Finds the bounding_polytope of a mesh. For the tree only.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/geometry/tree/bounding_polytope.h"

namespace clench {

/// points  about the tree's centre, at least one [m]; fewer than 2^27
/// axes    of a box that fits them well: its columns, orthonormal
BoundingPolytope make_bounding_polytope(const std::vector<Eigen::Vector3d>& points,
                                        const Eigen::Matrix3d& axes);

}  // namespace clench
