// Linear complementarity problems, solved by pivoting.
#pragma once
#include <Eigen/Core>

namespace clench {

enum class LcpStatus {
  solved,
  /// the pivots end on a ray: no solution found, and none exists if M is copositive-plus
  ray,
  iteration_limit  ///< or rounding made a basis singular
};

struct LcpSolution {
  LcpStatus status = LcpStatus::iteration_limit;
  Eigen::VectorXd z;  ///< 0 unless solved
  int iterations = 0;
};

/// z >= 0 with w = M z + q >= 0 and z.w = 0, by Lemke's method with a covering vector of ones. Ties
/// are broken lexicographically, so that pivots never cycle, and deterministically. Dense: up to a
/// few hundred rows, with coefficients of about one.
///
/// max_iterations  0: 50 per row, and 200
/// throws          Stopped (see base/watched.h)
/// source          Cottle, Pang & Stone (1992), The linear complementarity problem, 4.4 and 4.9
LcpSolution solve_lcp(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, int max_iterations = 0);

}  // namespace clench
