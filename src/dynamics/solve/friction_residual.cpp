#include "clench/dynamics/solve/friction_residual.h"

#include <algorithm>
#include <cmath>

namespace clench {
namespace {

bool valid(const FrictionProblem::Block& block) {
  return block.is_contact() ? std::isfinite(block.mu) && block.mu >= 0
                            : block.low <= 0 && block.high >= 0;
}

}  // namespace

void project_on_friction_cone(double mu, int tangents, double* r) {
  double t = 0;
  for (int k = 1; k <= tangents; ++k) t += r[k] * r[k];
  t = std::sqrt(t);
  if (r[0] >= 0 && t <= mu * r[0]) return;
  if (mu * t <= -r[0]) {
    std::fill(r, r + 1 + tangents, 0.0);
    return;
  }
  // on the cone's boundary: along (1, mu), in the plane of n and r
  r[0] = (r[0] + mu * t) / (1 + mu * mu);
  const double scale = t > 0 ? mu * r[0] / t : 0;
  for (int k = 1; k <= tangents; ++k) r[k] *= scale;
}

double block_fault(const FrictionProblem::Block& block, double d, const double* r,
                   const double* u) {
  if (!block.is_contact()) {
    const double dr = d * r[0];
    // an infinite bound stays infinite where d is 0
    const double low = std::isinf(block.low) ? block.low : d * block.low;
    const double high = std::isinf(block.high) ? block.high : d * block.high;
    return std::abs(dr - std::clamp(dr - u[0], low, high));
  }
  double slip = 0;
  for (int k = 1; k <= block.tangents; ++k) slip += u[k] * u[k];
  double p[4] = {d * r[0] - u[0] - block.mu * std::sqrt(slip)};
  for (int k = 1; k <= block.tangents; ++k) p[k] = d * r[k] - u[k];
  project_on_friction_cone(block.mu, block.tangents, p);
  double fault = 0;
  for (int k = 0; k <= block.tangents; ++k) fault += (d * r[k] - p[k]) * (d * r[k] - p[k]);
  return std::sqrt(fault);
}

double block_admittance(const FrictionProblem& problem, const FrictionProblem::Block& block) {
  return problem.W.diagonal().segment(block.row, block.size()).mean();
}

// admittance  of a block
template <class Problem, class Admittance>
static FrictionFault fault_of(const Problem& problem, const Eigen::VectorXd& r,
                              const Eigen::VectorXd& u, double tolerance, Admittance admittance) {
  // |W_ij| <= sqrt(W_ii W_jj): bounds the terms of the sums in u
  double size = 0;
  for (const auto& block : problem.blocks) {
    double sum = 0;
    for (int k = 0; k < block.size(); ++k) sum += std::abs(r[block.row + k]);
    if (sum > 0) size += std::sqrt(std::max(0.0, admittance(block))) * sum;
  }
  FrictionFault worst;
  for (const auto& block : problem.blocks) {
    const double d = admittance(block);
    const double fault = block_fault(block, d, &r[block.row], &u[block.row]);
    // 0, or not a number
    double none = 0 * d;
    for (int k = 0; k < block.size(); ++k) none += 0 * (r[block.row + k] + u[block.row + k]);
    if (!valid(block) || !std::isfinite(fault + none)) {
      worst.largest = worst.excess = std::numeric_limits<double>::infinity();
      return worst;
    }
    const double rounding = std::min(4e-16 * size * std::sqrt(std::max(0.0, d)), 1e6 * tolerance);
    worst.largest = std::max(worst.largest, fault);
    worst.excess = std::max(worst.excess, fault / (tolerance + rounding));
  }
  return worst;
}

FrictionFault friction_fault(const FrictionProblem& problem, const Eigen::VectorXd& r,
                             const Eigen::VectorXd& u, double tolerance) {
  return fault_of(problem, r, u, tolerance, [&](const FrictionProblem::Block& block) {
    return block_admittance(problem, block);
  });
}

FrictionFault friction_fault(const TreeFriction& problem, const Eigen::VectorXd& r,
                             const Eigen::VectorXd& u, double tolerance) {
  return fault_of(problem, r, u, tolerance,
                  [](const TreeFriction::Block& block) { return block.d; });
}

double friction_residual(const FrictionProblem& problem, const Eigen::VectorXd& r) {
  return friction_fault(problem, r, problem.W * r + problem.q, 1).largest;
}

}  // namespace clench
