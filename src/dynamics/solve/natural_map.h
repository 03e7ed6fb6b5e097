// The natural map of a block of a friction problem, whose zeros are its solutions, and the branch
// of it that is active at given impulses.
#pragma once
#include "clench/dynamics/solve/friction_problem.h"

namespace clench {

enum class BlockState : char { fixed, low, high, free, sticks, slides };

/// A block at impulses r with velocities u: its state, and the squared norm of the natural map, the
/// difference between r and the projection of r - rho u / d onto the admissible set of r.
/// d      mean of the diagonal of W over its rows
/// r, u   of its rows
/// slide  for a sliding contact: friction over the length of the tangential impulse, and from
///        slide[1] on the unit direction of that impulse
double natural_map(const FrictionProblem::Block& block, double d, double rho, const double* r,
                   const double* u, BlockState& state, double* slide);

}  // namespace clench
