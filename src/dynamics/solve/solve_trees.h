// Solves large islands of contacts in the coordinates of their trees of bodies.
#pragma once
#include "clench/base/progress.h"
#include "clench/dynamics/solve/tree_friction.h"
#include "clench/dynamics/solve/tree_newton.h"

namespace clench {

struct TreeFrictionOptions {
  /// Largest residual of a solution [m/s]; rounding is allowed for in addition, as in
  /// FrictionOptions.
  double tolerance = 1e-12;
  /// No other initial impulses and dampings are tried at a residual of at most this [m/s]: the last
  /// digits take many times the iterations of those before.
  double acceptable = 1e-10;
  /// Try other initial impulses and dampings if the first ones fail.
  bool restarts = true;
};

/// Solves the same problem as FrictionSolver, with round cones only, for islands of many trees: no
/// matrix of all rows is formed. Among many solutions it returns one near the warm start.
///
/// Proximal point method: damping pulls the impulses towards the present ones, and Newton's method
/// solves the damped problem roughly. Weak damping needs fewer rounds, strong damping converges
/// more reliably. Once few states change, Newton steps without damping finish the solution.
class TreeFrictionSolver {
 public:
  /// Keeps only scratch memory between calls: the same problem and warm start give the same bits.
  /// problem      after finish(); if it has a number that is not finite: r = u = 0, residual
  ///              infinite
  /// warm_start   one impulse per row; returned unchanged if it solves the problem
  /// throws       Stopped
  FrictionSolution solve(const TreeFriction& problem, const Eigen::VectorXd& warm_start,
                         const TreeFrictionOptions& options = {}, const Progress& progress = {});

 private:
  double measure(const TreeFriction& problem, double tolerance, Eigen::VectorXd& r,
                 FrictionSolution& solution);
  bool refine(const TreeFriction& problem, double tolerance, double& residual,
              FrictionSolution& solution);
  struct Effort {
    int patience;        ///< rounds in which the residual may fail to fall to a tenth
    int max_iterations;  ///< of Newton's method for one damped problem
    double roughly;      ///< share of the natural map that a damped problem may keep
  };
  void approach(const TreeFriction& problem, double damping, double rho, const Effort& effort,
                double tolerance, const Progress& progress, FrictionSolution& solution);

  TreeNewton newton_;
  Eigen::VectorXd r_, next_, z_, u_;
};

}  // namespace clench
