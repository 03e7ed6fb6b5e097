// Rotations from the directions of axes.
#pragma once
#include <Eigen/Geometry>
#include <optional>

namespace clench {

/// The rotation whose axis i (0: x, 1: y, 2: z) is along a, and whose axis j is as close to b as
/// orthogonality permits.
/// returns  empty if a or b is zero or not finite, or if they are parallel to 1e-9
std::optional<Eigen::Quaterniond> rotation_from_axes(int i, const Eigen::Vector3d& a, int j,
                                                     const Eigen::Vector3d& b);

}  // namespace clench
