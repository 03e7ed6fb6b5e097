// Solves contacts with Coulomb's friction, joint limits and motors together.
#pragma once
#include <optional>

#include "clench/dynamics/solve/friction_newton.h"
#include "clench/dynamics/solve/friction_problem.h"
#include "clench/dynamics/solve/gauss_seidel.h"
#include "clench/model/dynamic_settings.h"

namespace clench {

struct FrictionOptions {
  FrictionCone cone = FrictionCone::round;
  /// of a pyramid, >= 4; with torsion 3 edges - 4 (see pyramid_directions). Where all contacts
  /// stick in the round cone inside the pyramid, its solution is taken; otherwise that of the linear
  /// complementarity problem
  int edges = 8;
  /// Faults up to so much are none [m/s]; by default 1e-12 of the largest velocity in q, and of at
  /// least 1e-3. Rounding of W r is allowed for beside it, up to 1e6 times as much where masses
  /// differ by that; of a pyramid, as pivots lose digits, 100 times.
  std::optional<double> tolerance = {};
};

/// Solves one problem after another; memory is kept between them, nothing else: the same problem
/// and the same warm start give the same bits.
///
/// Of many solutions, as at the four corners of a box, it is the one of least sum of w_i r_i^2 of
/// its states (open, sticking, sliding), wherever it starts from: w_i is the mean of W_ii over all
/// contacts of the same two bodies. A warm start that already solves the problem of round cones is
/// returned as it is, for the price of W r; one that all but does may end in a solution near it.
/// Demands that contradict each other (two opposite limits that both ask for more) get as much as
/// can be had, with least squares of what is missing and without great impulses; then the solution
/// is not `solved`.
///
/// The ways, the next where one does not end: from the warm start along a path of states, with a
/// damping that is 1e-8 of W's diagonal and is then taken away again; in a heap, whose path seldom
/// ends, damping that pulls to the last iterate instead of 0 (proximal points, Rockafellar 1976),
/// which may end in a solution near the warm start; Newton's method after sweeps of Gauss and
/// Seidel's; down from strong damping, step by step; and proximal points again, also from a
/// pyramid's solution.
class FrictionSolver {
 public:
  /// problem      of a number that is not finite or a block that is none: r = u = 0, residual
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
  /// r of a problem with damping; returns how strong that still is.
  double solve_damped(Eigen::VectorXd& r, FrictionSolution& solution);
  double descend(double rho, Eigen::VectorXd& r, FrictionSolution& solution);
  /// Takes the damping away; keeps the best r in the solution.
  bool refine(const FrictionProblem& problem, double tolerance, double by, int max_iterations,
              Eigen::VectorXd& r, FrictionSolution& solution);

  ScaledFriction scaled_;
  FrictionNewton newton_;
  GaussSeidel gauss_seidel_;
  Eigen::VectorXd u_, r_, pull_, impulses_, velocities_;
};

}  // namespace clench
