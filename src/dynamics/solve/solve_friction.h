// Solves contacts with Coulomb's friction, joint limits and motors together.
#pragma once
#include "clench/dynamics/solve/friction_newton.h"
#include "clench/dynamics/solve/friction_problem.h"
#include "clench/dynamics/solve/gauss_seidel.h"
#include "clench/model/dynamic_settings.h"

namespace clench {

struct FrictionOptions {
  FrictionCone cone = FrictionCone::cone;
  int edges = 8;             ///< of a pyramid, >= 4; with torsion 3 edges - 4 (see friction_edges)
  /// Faults up to so much of the largest velocity in q, and of at least 1e-3, are none. Rounding of W r is allowed for beside it.
  double tolerance = 1e-12;
};

/// Solves one problem after another; memory is kept between them, nothing else: the same problem and the same warm start
/// give the same bits.
///
/// Of many solutions, as at the four corners of a box, it is the one of least sum of W_ii r_i^2 among those of the same
/// states, wherever it starts from. A warm start that already solves the problem is returned as it is.
/// Where demands contradict each other (two opposite limits), it is one of least violation.
class FrictionSolver {
 public:
  /// warm_start  impulses of the last step, or none (any other size)
  FrictionSolution solve(const FrictionProblem& problem, const Eigen::VectorXd& warm_start, const FrictionOptions& options = {});

 private:
  FrictionSolution solve_as_pyramid(const FrictionProblem& problem, double tolerance, int edges_per_contact);
  bool newton(double by, double rho, int max_iterations, Eigen::VectorXd& r, FrictionSolution& solution);
  double descend(double rho, Eigen::VectorXd& r, FrictionSolution& solution);
  double solve_damped(Eigen::VectorXd& r, FrictionSolution& solution);
  bool solve_by_pyramids(double by, int edges_per_contact, Eigen::VectorXd& r, FrictionSolution& solution);
  bool refine(const FrictionProblem& problem, double tolerance, double by, int max_iterations, Eigen::VectorXd& r, FrictionSolution& solution);

  ScaledFriction scaled_;
  FrictionNewton newton_;
  GaussSeidel gauss_seidel_;
  Eigen::VectorXd u_, r_, pull_, impulses_, velocities_;
};

FrictionSolution solve_friction(const FrictionProblem& problem, const Eigen::VectorXd& warm_start,
                                const FrictionOptions& options = {});

}  // namespace clench
