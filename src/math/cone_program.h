// Convex programs over second-order cones, of grasp size: up to some hundred unknowns.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

/// minimise 1/2 x.P x + c.x  subject to  A x = b,  G x + s = h,  s in K: the first `nonnegative`
/// rows of s are >= 0, then come second-order cones (t, u), |u| <= t, of the sizes given. P, A or G
/// may be empty.
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
  infeasible,  ///< no x meets the constraints, none up to 1e12 times the data; y and z prove it
  unbounded,   ///< not proved infeasible, and the objective falls without end along x
  inaccurate,  ///< it does not pass its check: the best point found
};

/// With y of A x = b and z of G x + s = h, z in K:
///   optimal     P x + c + A^T y + G^T z = 0,  s.z = 0
///   infeasible  A^T y + G^T z = 0,  b.y + h.z = -1; x and s are 0
///   unbounded   P x = 0, A x = 0, G x + s = 0, c.x = -1; y and z are 0
struct ConeSolution {
  ConeStatus status = ConeStatus::inaccurate;
  Eigen::VectorXd x, y, z, s;
  /// what is about one of each unknown, as the data are: those of x far below it are rounding
  Eigen::VectorXd units;
  double objective = 0;  ///< at x; 0 without optimum
  /// of the equations above, relative to the size of data and solution; optimal: at most 1e-9
  double primal_residual = 0, dual_residual = 0, gap = 0;
  int iterations = 0;
};

/// The largest magnitude; 0 of none.
inline double max_norm(const Eigen::VectorXd& v) { return v.lpNorm<Eigen::Infinity>(); }

/// Of objectives that are smaller than this, in data scaled to one, the gap is measured against it.
inline constexpr double gap_floor = 1e-4;

}  // namespace clench
