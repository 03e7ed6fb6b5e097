#include "clench/dynamics/solve/solve_friction.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/dynamics/solve/friction_feasibility.h"
#include "clench/dynamics/solve/friction_pyramid.h"
#include "clench/dynamics/solve/friction_residual.h"

namespace clench {
namespace {

using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();
// fraction of a block's own diagonal: redundant contacts share their load equally to 1e-8 from any
// start of Newton's method; softness of 1e8 times that of a contact itself does not count as
// redundancy
constexpr double damping = 1e-8;
// If the forces of the last step have residuals below this and continuation fails, they are changed
// as little as possible: a nearly resting body would otherwise alternate between solutions [m/s].
constexpr double nearly_holds = 1e-4;
// With so many rows few paths are completed, and each step of one is expensive: proximal points are
// tried before the other strategies.
constexpr int many_rows = 60;

}  // namespace

bool FrictionSolver::newton(double by, double rho, int max_iterations, VectorXd& r,
                            FrictionSolution& solution) {
  const auto end = newton_.solve(scaled_, scaled_.q, by, rho, max_iterations, r);
  solution.iterations += end.iterations;
  return end.converged;
}

bool FrictionSolver::follow(double by, int max_iterations, VectorXd& r,
                            FrictionSolution& solution) {
  const auto end = newton_.follow(scaled_, scaled_.q, by, max_iterations, r);
  solution.iterations += end.iterations;
  return end.converged;
}

double FrictionSolver::solve_damped(VectorXd& r, FrictionSolution& solution) {
  gauss_seidel_.set(scaled_, damping);
  gauss_seidel_.sweep(scaled_, 3, r);
  solution.iterations += 3;
  // redundant contacts are detected stepwise
  r_ = r;
  if (newton(1e-3, 1, 12, r_, solution)) {
    r = r_;
    if (follow(1e-5, 20, r_, solution) && follow(damping, 20, r_, solution)) {
      r.swap(r_);
      return damping;
    }
  }
  if (newton(damping, 1, 12, r, solution)) return damping;
  return descend(1, r, solution);
}

double FrictionSolver::descend(double rho, VectorXd& r, FrictionSolution& solution) {
  double reached = 4, shrink = 0.25;
  r.setZero();
  for (int round = 0; round < 40 && reached > damping && shrink < 0.99; ++round) {
    const double level = std::max(reached * shrink, damping);
    r_ = r;
    bool found = newton(level, rho, 10, r_, solution);
    if (!found) {
      r_ = r;
      found = follow(level, 20, r_, solution);
    }
    if (!found) {
      gauss_seidel_.set(scaled_, level);
      int sweeps = 3;
      for (const double other : {0.2, 5.0, 1.0, 0.04, 25.0}) {
        r_ = r;
        gauss_seidel_.sweep(scaled_, sweeps, r_);
        solution.iterations += sweeps;
        sweeps += 2;
        found = newton(level, rho * other, 15, r_, solution);
        if (found) break;
      }
    }
    if (found) {
      r.swap(r_);
      reached = level;
      shrink = std::max(shrink * shrink, 1e-3);
    } else {
      shrink = std::sqrt(shrink);
    }
  }
  return reached;
}

bool FrictionSolver::refine(const FrictionProblem& problem, double tolerance, double by,
                            int max_iterations, VectorXd& r, FrictionSolution& solution) {
  // sets u_ and keeps the best
  bool enough = false;
  const auto measure = [&](VectorXd& at) {
    check_stop();
    // bounds hold bit-exactly
    for (const auto& block : scaled_.blocks)
      at[block.row] = block.is_contact() ? std::max(at[block.row], 0.0)
                                         : std::clamp(at[block.row], block.low, block.high);
    u_ = scaled_.q;
    u_.noalias() += scaled_.S * at;
    impulses_ = at.cwiseProduct(scaled_.units);
    velocities_ = u_.cwiseQuotient(scaled_.units);
    const FrictionFault fault = friction_fault(problem, impulses_, velocities_, tolerance);
    enough = fault.excess <= 1;
    if (enough || fault.largest < solution.residual)
      solution.residual = fault.largest, solution.r = impulses_;
    return fault.largest;
  };
  double residual = measure(r);
  bool straight = true;
  for (int i = 0; i < max_iterations; ++i) {
    if (enough) return true;
    if (straight) {
      r_ = r;
      ++solution.iterations;
      if (newton_.refine(scaled_, by, u_, r_)) {
        const double next = measure(r_);
        if (enough || next < 0.5 * residual) {
          r.swap(r_);
          residual = next;
          continue;
        }
      }
    }
    // the damping pulls to the present iterate, no longer to 0
    const VectorXd q = scaled_.q - by * scaled_.weights.cwiseProduct(r);
    bool found = false;
    for (const double rho : {1.0, 0.2, 5.0}) {
      r_ = r;
      const auto end = newton_.solve(scaled_, q, by, rho, 15, r_);
      solution.iterations += end.iterations;
      found = end.converged;
      if (found) break;
    }
    if (found) {
      const double next = measure(r_);
      straight = false;
      if (next > 0.3 * residual)
        by = std::max(by / 2, 1e-14);
      else if (next > 0.01 * residual)
        by = std::max(by / 30, 1e-11);
      r.swap(r_);
      residual = next;
    } else {
      by = std::min(by * 8, 1.0);
      measure(r);
    }
  }
  return enough;
}

// Do all pressing contacts stick?
static bool all_stick(const FrictionProblem& problem, const FrictionSolution& solution,
                      double tolerance) {
  for (const auto& block : problem.blocks) {
    if (block.tangents <= 0 || solution.r[block.row] <= 0) continue;
    if (solution.u.segment(block.row + 1, block.tangents).norm() > 10 * tolerance) return false;
  }
  return true;
}

FrictionSolution FrictionSolver::solve_as_pyramid(const FrictionProblem& problem,
                                                  const VectorXd& warm_start, double tolerance,
                                                  int edges_per_contact, const Progress& progress) {
  FrictionProblem inner = problem;
  inner.blocks = inscribed_cones(std::move(inner.blocks), edges_per_contact);
  FrictionSolution solution = solve(inner, warm_start, {.tolerance = tolerance}, progress);
  if (solution.solved && all_stick(inner, solution, tolerance)) return solution;
  // if no pyramid is solved, the solution of the inner cones remains
  solution.solved = false;
  double least = infinity;
  scaled_.set(problem);
  std::vector<Eigen::MatrixXd> edges;
  for (const auto& block : scaled_.blocks)
    edges.push_back(pyramid_directions(block.tangents, edges_per_contact));
  VectorXd r = VectorXd::Zero(scaled_.rows());
  // pivots lose digits far below 1
  double by = 1e-6;
  for (int round = 0; round < 20 && !solution.solved; ++round) {
    const PyramidSolution pyramid = solve_pyramid(scaled_, by, r, edges);
    solution.iterations += pyramid.iterations;
    if (pyramid.found && pyramid.residual < least) {
      r = pyramid.r;
      solution.residual = least = pyramid.residual;
      solution.r = r.cwiseProduct(scaled_.units);
      solution.solved = solution.residual <= 100 * tolerance;
    } else {
      solution.fell_back = true;
      by = std::min(10 * by, 1.0);
    }
  }
  solution.u = problem.W * solution.r + problem.q;
  return solution;
}

FrictionSolution FrictionSolver::solve(const FrictionProblem& problem, const VectorXd& warm_start,
                                       const FrictionOptions& options, const Progress& progress) {
  FrictionSolution solution;
  newton_.watch(progress);
  const int n = static_cast<int>(problem.q.size());
  const double largest = std::max(1e-3, n > 0 ? problem.q.lpNorm<Eigen::Infinity>() : 0);
  const double tolerance = options.tolerance.value_or(1e-12 * largest);
  solution.r = warm_start.size() == n && warm_start.allFinite() ? warm_start : VectorXd::Zero(n);
  solution.u = problem.q;
  solution.u.noalias() += problem.W * solution.r;
  check_stop();
  const FrictionFault fault = friction_fault(problem, solution.r, solution.u, tolerance);
  check_stop();
  solution.residual = fault.largest;
  solution.solved = fault.excess <= 1;
  const bool finite =
      problem.q.allFinite() && problem.W.allFinite() && std::isfinite(fault.largest);
  if (solution.solved && finite && options.cone == FrictionCone::round) return solution;
  if (!finite) {
    solution.solved = false;
    solution.residual = infinity;
    solution.r.setZero(), solution.u.setZero();
    return solution;
  }
  if (options.cone == FrictionCone::pyramid)
    return solve_as_pyramid(problem, solution.r, tolerance, options.edges, progress);
  scaled_.set(problem);
  VectorXd r = solution.r.cwiseQuotient(scaled_.units);
  double reached = damping;
  if (!r.isZero(0)) {
    const VectorXd warm = r;
    if (!follow(damping, 30, r, solution)) {
      r = warm;
      if (fault.largest < nearly_holds)
        solution.solved = refine(problem, tolerance, 10 * damping, 8, r, solution);
      if (!solution.solved && scaled_.rows() > many_rows) {
        gauss_seidel_.set(scaled_, damping);
        gauss_seidel_.sweep(scaled_, 10, r = warm);
        solution.iterations += 10;
        solution.solved = refine(problem, tolerance, 1e-3, 40, r, solution);
      }
      if (!solution.solved) reached = solve_damped(r = warm, solution);
    }
  } else {
    reached = solve_damped(r, solution);
  }
  if (solution.solved) {
    solution.u = problem.W * solution.r + problem.q;
    return solution;
  }
  // velocities added by the damping
  pull_ = reached * scaled_.weights.cwiseProduct(r);
  solution.solved = refine(problem, tolerance, reached, 40, r, solution);
  solution.fell_back = reached > damping || !solution.solved;
  if (!solution.solved && may_contradict(scaled_)) {
    // targets minus the part of them that cannot be reached
    scaled_.q += pull_;
    r.setZero();
    FrictionSolution nearest;
    nearest.residual = infinity;
    solve_damped(r, nearest);
    nearest.r = r.cwiseProduct(scaled_.units);
    nearest.iterations += solution.iterations;
    nearest.fell_back = true;
    nearest.residual = friction_residual(problem, nearest.r);
    nearest.u = problem.W * nearest.r + problem.q;
    return nearest;
  }
  // from other starting points, at last from the best result so far
  for (const double rho : {0.2, 5.0, 0.05, 0.0}) {
    if (solution.solved) break;
    double level = 1e-3;
    if (rho > 0)
      level = descend(rho, r, solution);
    else
      r = solution.r.cwiseQuotient(scaled_.units);
    solution.solved = refine(problem, tolerance, level, 100, r, solution);
  }
  solution.u = problem.W * solution.r + problem.q;
  return solution;
}

}  // namespace clench
