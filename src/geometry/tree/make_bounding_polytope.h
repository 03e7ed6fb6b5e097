// Computes the bounding_polytope of a mesh. For the tree only.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/geometry/tree/bounding_polytope.h"

namespace clench {

/// points  about the tree's center, at least one [m]; fewer than 2^27
/// axes    of a tightly fitting box: its columns, orthonormal
BoundingPolytope make_bounding_polytope(const std::vector<Eigen::Vector3d>& points,
                                        const Eigen::Matrix3d& axes);

}  // namespace clench
