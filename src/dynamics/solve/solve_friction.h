// Solves contacts with Coulomb friction, joint limits and motors together.
#pragma once
#include <optional>

#include "clench/dynamics/solve/friction_newton.h"
#include "clench/dynamics/solve/friction_problem.h"
#include "clench/dynamics/solve/gauss_seidel.h"
#include "clench/model/dynamic_settings.h"

namespace clench {

struct FrictionOptions {
  FrictionCone cone = FrictionCone::round;
  /// edges of a friction pyramid, >= 4; with torsion 3 edges - 4 (see pyramid_directions). If all
  /// contacts stick in the round cone inside the pyramid, that solution is used; otherwise that of
  /// the linear complementarity problem
  int edges = 8;
  /// Tolerance of residuals [m/s]; by default 1e-12 of the largest velocity in q, and of at least
  /// 1e-3. Rounding of W r is allowed in addition, up to 1e6 times as much if masses differ by that
  /// factor; for a pyramid, as pivots lose digits, 100 times.
  std::optional<double> tolerance = {};
};

/// Solves one problem after another; only memory is kept between them: the same problem and the
/// same warm start give the same bits.
///
/// Among many solutions, as at the four corners of a box, it returns the one with the least sum of
/// w_i r_i^2 for its states (open, sticking, sliding), independent of the start: w_i is the mean of
/// W_ii over all contacts of the same two bodies. A warm start that already solves the problem of
/// round cones is returned unchanged, at the cost of W r; from one that nearly does, a solution
/// near it may result. Contradictory targets (two opposite limits that both require more) are met
/// in the least-squares sense without large impulses; then the solution is not `solved`.
///
/// Strategies, tried in order until one converges: from the warm start along a path of states, with
/// a damping of 1e-8 of W's diagonal that is then removed; in a heap, whose path is seldom
/// completed, damping that pulls to the last iterate instead of 0 (proximal points, Rockafellar
/// 1976), which may give a solution near the warm start; Newton's method after Gauss-Seidel sweeps;
/// from strong damping to weak, step by step; and proximal points again, also from a pyramid's
/// solution.
class FrictionSolver {
 public:
  /// problem      with a number that is not finite or an invalid block: r = u = 0, residual
  ///              infinite
  /// warm_start   impulses of the last step, or none (any other size)
  /// throws       Stopped
  FrictionSolution solve(const FrictionProblem& problem, const Eigen::VectorXd& warm_start,
                         const FrictionOptions& options = {}, const Progress& progress = {});

 private:
  FrictionSolution solve_as_pyramid(const FrictionProblem& problem,
                                    const Eigen::VectorXd& warm_start, double tolerance, int edges,
                                    const Progress& progress);
  bool newton(double by, double rho, int max_iterations, Eigen::VectorXd& r,
              FrictionSolution& solution);
  bool follow(double by, int max_iterations, Eigen::VectorXd& r, FrictionSolution& solution);
  /// r of a problem with damping.
  /// returns  the strength of the damping that remains
  double solve_damped(Eigen::VectorXd& r, FrictionSolution& solution);
  double descend(double rho, Eigen::VectorXd& r, FrictionSolution& solution);
  /// Removes the damping; keeps the best r in the solution.
  bool refine(const FrictionProblem& problem, double tolerance, double by, int max_iterations,
              Eigen::VectorXd& r, FrictionSolution& solution);

  ScaledFriction scaled_;
  FrictionNewton newton_;
  GaussSeidel gauss_seidel_;
  Eigen::VectorXd u_, r_, pull_, impulses_, velocities_;
};

}  // namespace clench
