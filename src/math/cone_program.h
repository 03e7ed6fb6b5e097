// Convex programs over second-order cones, of the size of grasp problems: up to a few hundred
// unknowns.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

/// minimize 1/2 x.P x + c.x  subject to  A x = b,  G x + s = h,  s in K: the first `nonnegative`
/// rows of s are >= 0, followed by second-order cones (t, u), |u| <= t, of the given sizes. P, A or
/// G may be empty.
struct ConeProgram {
  Eigen::MatrixXd P;  ///< symmetric, positive semidefinite
  Eigen::VectorXd c;  ///< one per unknown
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::MatrixXd G;
  Eigen::VectorXd h;
  int nonnegative = 0;
  std::vector<int> cones = {};  ///< sizes of the second-order cones, >= 1
};

enum class ConeStatus {
  optimal,
  infeasible,  ///< no x of up to 1e12 times the data satisfies the constraints; y and z prove it
  unbounded,   ///< not proved infeasible, and the objective decreases without limit along x
  inaccurate,  ///< the result does not pass its check: the best point found
};

/// With y of A x = b and z of G x + s = h, z in K:
///  optimal     P x + c + A^T y + G^T z = 0,  s.z = 0
///  infeasible  A^T y + G^T z = 0,  b.y + h.z = -1; x and s are 0
///  unbounded   P x = 0, A x = 0, G x + s = 0, c.x = -1; y and z are 0
struct ConeSolution {
  ConeStatus status = ConeStatus::inaccurate;
  Eigen::VectorXd x, y, z, s;
  /// typical size of each unknown, given the data: values of x far below it are rounding errors
  Eigen::VectorXd units;
  double objective = 0;  ///< objective at x; 0 without an optimum
  /// residual of the equations above, relative to the size of data and solution; optimal: at most
  /// 1e-9
  double primal_residual = 0, dual_residual = 0, gap = 0;
  int iterations = 0;
};

/// The largest magnitude; 0 for an empty vector.
inline double max_norm(const Eigen::VectorXd& v) { return v.lpNorm<Eigen::Infinity>(); }

/// Reference size of the duality gap for smaller objectives, with data scaled to one.
inline constexpr double gap_floor = 1e-4;

}  // namespace clench
