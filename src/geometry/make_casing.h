// Finds the casing of a mesh. For the tree only.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "geometry/casing.h"

namespace clench {

/// points  about the tree's centre, at least one [m]; fewer than 2^27
/// axes    of a box that fits them well: its columns, orthonormal
Casing make_casing(const std::vector<Eigen::Vector3d>& points, const Eigen::Matrix3d& axes);

}  // namespace clench
