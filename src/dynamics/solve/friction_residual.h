// Residuals of the laws of contact and friction.
#pragma once
#include "clench/dynamics/solve/friction_problem.h"
#include "clench/dynamics/solve/tree_friction.h"

namespace clench {

/// Projects r onto the friction cone |r_t| <= mu r_n, in place; r has 1 + tangents rows.
void project_on_friction_cone(double mu, int tangents, double* r);

/// Residual of one block's law, as a velocity: |d r - P(d r - v)| with P the projection on the
/// friction cone and v = u + mu |u_t| n, or for a bounded row on [d low, d high] and v = u. It is 0
/// exactly if the law holds: Coulomb's law is the complementarity of r in the friction cone and v
/// in its dual.
///
/// r, u     the block's own rows
/// d        change of the block's velocity per impulse: the mean of its diagonal of W
/// source   De Saxcé & Feng (1998), The bipotential method
double block_fault(const FrictionProblem::Block& block, double d, const double* r, const double* u);

/// The d of block_fault.
double block_admittance(const FrictionProblem& problem, const FrictionProblem::Block& block);

/// Residuals of impulses.
struct FrictionFault {
  /// largest residual of any block; infinite if a number is not finite or a block is invalid
  double largest = 0;
  /// largest ratio of a block's residual to its allowance: the tolerance plus the rounding of W r
  double excess = 0;
};
/// u  W r + q
FrictionFault friction_fault(const FrictionProblem& problem, const Eigen::VectorXd& r,
                             const Eigen::VectorXd& u, double tolerance);
FrictionFault friction_fault(const TreeFriction& problem, const Eigen::VectorXd& r,
                             const Eigen::VectorXd& u, double tolerance);

/// The largest residual of any block [m/s, rad/s]; infinite if a number of the problem or of r is
/// not finite (except bounds), a coefficient of friction is negative, or 0 is not within the bounds
/// of a row.
double friction_residual(const FrictionProblem& problem, const Eigen::VectorXd& r);

}  // namespace clench
