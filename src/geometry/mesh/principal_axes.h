// Principal directions of a small symmetric matrix, bit-identical on all machines.
#pragma once
#include <Eigen/Core>

namespace clench {

/// Orthonormal eigenvectors as columns, right-handed, smallest eigenvalue first; the identity for a
/// matrix that is zero or not finite.
/// source  Jacobi rotations, Golub & Van Loan (2013), ch. 8.5
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& symmetric);

}  // namespace clench
