#include "clench/dynamics/solve/solve_friction.h"

#include <algorithm>
#include <cmath>

#include "clench/dynamics/solve/friction_residual.h"

namespace clench {
namespace {

using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();
// of a block's own diagonal: redundant contacts share their load to 1e-8 the same way wherever Newton starts, and what is
// 1e8 times as soft as a contact itself is still no redundancy
constexpr double damping = 1e-8;

}  // namespace

// what one block misses, in velocities of the problem
double FrictionSolver::fault(const FrictionProblem& problem, const VectorXd& r, const VectorXd& u) const {
  double largest = 0;
  for (const auto& block : problem.blocks) {
    const double value = block_fault(block, block_admittance(problem, block), &r[block.row], &u[block.row]);
    if (!(value <= largest)) largest = std::isnan(value) ? infinity : value;
  }
  return largest;
}

bool FrictionSolver::newton(double by, int max_iterations, VectorXd& r, FrictionSolution& solution) {
  const auto end = newton_.solve(scaled_, by, max_iterations, r);
  solution.iterations += end.iterations;
  return end.converged;
}

bool FrictionSolver::solve_damped(int max_rounds, double by, VectorXd& r, FrictionSolution& solution) {
  if (!r.isZero(0) && newton(by, 8, r, solution)) return true;
  gauss_seidel_.set(scaled_, by);
  gauss_seidel_.sweep(scaled_, 3, r);
  solution.iterations += 3;
  if (newton(by, 12, r, solution)) return true;
  // from strong damping, where blocks hardly feel each other, down to none to speak of
  double level = 1, shrink = 0.1;
  r.setZero();
  r_ = r;
  for (int round = 0; round < max_rounds; ++round) {
    gauss_seidel_.set(scaled_, level);
    for (int sweeps = 3; sweeps < 20; sweeps *= 2) {
      gauss_seidel_.sweep(scaled_, sweeps, r_);
      solution.iterations += sweeps;
      if (newton(level, 20, r_, solution)) {
        sweeps = 0;
        break;
      }
    }
    // (probe)
    VectorXd check = r_;
    const bool ok = newton(level, 20, check, solution);
    if (ok) {
      r = check;
      if (level <= by) return true;
    }
    r_ = r;
    (void)shrink;
    level = std::max(level * shrink, by);
  }
  return false;
}

bool FrictionSolver::refine(const FrictionProblem& problem, double tolerance, VectorXd& r, FrictionSolution& solution) {
  double by = damping, last = infinity;
  for (int i = 0; i < 40; ++i) {
    u_ = scaled_.S * r + scaled_.q;
    const VectorXd impulses = r.cwiseProduct(scaled_.units);
    const double residual = fault(problem, impulses, u_.cwiseQuotient(scaled_.units));
    if (residual < solution.residual) solution.residual = residual, solution.r = impulses;
    // u = W r + q is known to the rounding of its sums only
    const VectorXd size = scaled_.weights.cwiseSqrt();
    const double rounding = 4e-16 * size.dot(r.cwiseAbs()) * size.cwiseQuotient(scaled_.units).maxCoeff();
    if (residual <= tolerance + std::min(rounding, 1e-6 * tolerance / 1e-12)) return true;
    if (residual > 0.3 * last) by = std::max(by / 100, 1e-15);
    last = residual;
    ++solution.iterations;
    if (!newton_.refine(scaled_, by, u_, r)) return false;
  }
  return false;
}

FrictionSolution FrictionSolver::solve(const FrictionProblem& problem, const VectorXd& warm_start, const FrictionOptions& options) {
  FrictionSolution solution;
  const int n = static_cast<int>(problem.q.size());
  const double tolerance = options.tolerance * std::max(1e-3, n > 0 ? problem.q.lpNorm<Eigen::Infinity>() : 0);
  solution.r = warm_start.size() == n && warm_start.allFinite() ? warm_start : VectorXd::Zero(n);
  solution.residual = friction_residual(problem, solution.r);
  if (solution.residual <= tolerance || !(solution.residual < infinity)) {
    solution.solved = solution.residual <= tolerance;
    solution.u = problem.W * solution.r + problem.q;
    return solution;
  }
  scaled_.set(problem);
  VectorXd r = solution.r.cwiseQuotient(scaled_.units);
  solve_damped(40, damping, r, solution);
  solution.solved = refine(problem, tolerance, r, solution);
  solution.u = problem.W * solution.r + problem.q;
  return solution;
}

FrictionSolution solve_friction(const FrictionProblem& problem, const VectorXd& warm_start, const FrictionOptions& options) {
  FrictionSolver solver;
  return solver.solve(problem, warm_start, options);
}

}  // namespace clench
