#include "clench/dynamics/solve/solve_trees.h"

#include <algorithm>
#include <cmath>

#include "clench/dynamics/solve/friction_residual.h"

namespace clench {

using Eigen::VectorXd;

// Clamps impulses to their bounds and returns their fault [m/s]; `solution` keeps the best ones.
double TreeFrictionSolver::measure(const TreeFriction& problem, double tolerance, VectorXd& r,
                                   FrictionSolution& solution) {
  for (const auto& block : problem.blocks)
    r[block.row] = block.is_contact() ? std::max(r[block.row], 0.0)
                                      : std::clamp(r[block.row], block.low, block.high);
  problem.move(r, z_);
  problem.velocities(r, z_, u_);
  const FrictionFault fault = friction_fault(problem, r, u_, tolerance);
  if (fault.excess <= 1 || fault.largest < solution.residual)
    solution.r = r, solution.u = u_, solution.residual = fault.largest;
  solution.solved = fault.excess <= 1;
  return fault.largest;
}

// A Newton step from r_ without damping towards a center.   returns  false: it reduced the residual
// too little, and r_ is unchanged
bool TreeFrictionSolver::refine(const TreeFriction& problem, double tolerance, double& residual,
                                FrictionSolution& solution) {
  constexpr double weak = 1e-6;
  ++solution.iterations;
  next_ = r_;
  if (!newton_.refine(problem, weak, next_)) return false;
  const double next = measure(problem, tolerance, next_, solution);
  if (!solution.solved && !(next < 0.3 * residual)) return false;
  r_.swap(next_);
  residual = next;
  return true;
}

// Iterates proximal points from r_ until one solves the problem or the residual stops falling.
void TreeFrictionSolver::approach(const TreeFriction& problem, double damping, double rho,
                                  const Effort& effort, double tolerance, const Progress& progress,
                                  FrictionSolution& solution) {
  // if few iterations of Newton's method are enough for a damped problem, the damping is too strong
  constexpr int few = 4, some = 8;
  // residual below which states hardly change [m/s]
  constexpr double near = 1e-3;
  const int max_rounds = 5 * effort.patience;
  double residual = measure(problem, tolerance, r_, solution), mark = residual;
  bool found = true;
  for (int round = 0, since = 0; round < max_rounds && !solution.solved; ++round) {
    progress.check();
    if (found && residual < near && refine(problem, tolerance, residual, solution)) continue;
    next_ = r_;
    const auto end =
        newton_.solve(problem, {damping, r_, rho}, effort.roughly, effort.max_iterations, next_);
    solution.iterations += end.iterations;
    found = end.converged;
    if (found) {
      const double next = measure(problem, tolerance, next_, solution);
      if (next > 0.01 * residual)
        damping *= end.iterations <= few ? 0.1 : end.iterations <= some ? 0.5 : 1;
      damping = std::max(damping, 1e-10);
      r_.swap(next_), residual = next;
    } else {
      damping = std::min(4 * damping, 1.0);
    }
    if (residual < 0.1 * mark)
      mark = residual, since = 0;
    else if (++since > effort.patience)
      return;
  }
}

FrictionSolution TreeFrictionSolver::solve(const TreeFriction& problem, const VectorXd& warm_start,
                                           const TreeFrictionOptions& options,
                                           const Progress& progress) {
  FrictionSolution solution;
  solution.residual = std::numeric_limits<double>::infinity();
  solution.r = solution.u = VectorXd::Zero(problem.rows());
  r_ = warm_start.size() == problem.rows() && warm_start.allFinite() ? warm_start : solution.r;
  problem.move(r_, z_);
  problem.velocities(r_, z_, u_);
  const FrictionFault fault = friction_fault(problem, r_, u_, options.tolerance);
  if (!std::isfinite(fault.largest)) return solution;
  solution.r = r_, solution.u = u_, solution.residual = fault.largest;
  solution.solved = fault.excess <= 1;
  if (solution.solved) return solution;
  newton_.set(problem);
  // near a solution with many contacts about to slide, the residual stalls for some rounds before it
  // falls: giving up early is cheaper on average, and is tried first
  constexpr Effort efforts[] = {{8, 15, 0.3}, {24, 15, 0.3}, {24, 15, 0.9}, {24, 40, 0.3}};
  approach(problem, 1e-3, 1, efforts[0], options.tolerance, progress, solution);
  struct Start {
    bool best;  // true: from the best impulses so far; false: from zero
    double damping, rho;
  };
  constexpr Start starts[] = {{true, 1e-3, 3},  {false, 0.1, 1},   {false, 1e-3, 3},
                              {true, 0.1, 0.3}, {false, 1e-2, 10}, {true, 1e-2, 5},
                              {false, 1, 1},    {true, 1, 3},      {false, 1e-2, 0.3},
                              {true, 1e-4, 2},  {false, 1, 5},     {true, 0.1, 8}};
  for (const Effort& effort : efforts) {
    for (const Start& start : starts) {
      if (solution.solved || solution.residual <= options.acceptable || !options.restarts)
        return solution;
      solution.fell_back = true;
      r_ = start.best ? solution.r : VectorXd::Zero(problem.rows());
      approach(problem, start.damping, start.rho, effort, options.tolerance, progress, solution);
    }
  }
  return solution;
}

}  // namespace clench
