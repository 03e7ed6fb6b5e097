// Solves large islands of contacts by the trees of bodies.
#pragma once
#include "clench/base/progress.h"
#include "clench/dynamics/solve/tree_friction.h"
#include "clench/dynamics/solve/tree_newton.h"

namespace clench {

struct TreeFrictionOptions {
  /// Faults up to so much are none [m/s]; rounding is allowed for beside it, as in FrictionOptions.
  double tolerance = 1e-12;
  /// Starts anew from other impulses where the first start leads nowhere.
  bool restarts = true;
};

/// What FrictionSolver does for a problem of many trees, of round cones: time grows little faster
/// than the number of contacts. Of many solutions it is one near the warm start.
///
/// Proximal points: damping pulls the impulses to where they are, and Newton's method solves the
/// damped problem roughly; weaker damping gets nearer in fewer rounds, stronger damping is solved
/// more surely. Once few states change, steps without a center end it.
class TreeFrictionSolver {
 public:
  /// Keeps its memory, and nothing else: the same problem and warm start give the same bits.
  /// problem      finished; of a number that is not finite: r = u = 0, residual infinite
  /// warm_start   one impulse per row; where it solves the problem it is returned as it is
  /// throws       Stopped
  FrictionSolution solve(const TreeFriction& problem, const Eigen::VectorXd& warm_start,
                         const TreeFrictionOptions& options = {}, const Progress& progress = {});

 private:
  double measure(const TreeFriction& problem, double tolerance, Eigen::VectorXd& r,
                 FrictionSolution& solution);
  bool refine(const TreeFriction& problem, double tolerance, double& residual,
              FrictionSolution& solution);
  void approach(const TreeFriction& problem, double damping, double rho, double tolerance,
                const Progress& progress, FrictionSolution& solution);

  TreeNewton newton_;
  Eigen::VectorXd r_, next_, z_, u_;
};

}  // namespace clench
