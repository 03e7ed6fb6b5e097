// The singular value decomposition, compiled once: it is the longest to compile of all that Eigen has.
#pragma once
#include <Eigen/Core>

namespace clench {

/// m = u * diag(values) * v^T, values descending.
struct Svd {
  Eigen::MatrixXd u;       ///< rows x rows, orthonormal
  Eigen::VectorXd values;  ///< min(rows, columns)
  Eigen::MatrixXd v;       ///< columns x min(rows, columns), orthonormal columns
};

/// m  at least one row and one column, finite
Svd singular_value_decomposition(const Eigen::MatrixXd& m);

}  // namespace clench
