#include "clench/dynamics/solve/friction_feasibility.h"

#include <cmath>

#include "clench/math/solve_cone_program.h"

namespace clench {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Rows  sign * (S r + q)  in a cone, or 0.
struct Rows {
  std::vector<int> rows;
  std::vector<double> factors;
  void add(int row, double factor) { rows.push_back(row), factors.push_back(factor); }
  MatrixXd left(const ScaledFriction& problem) const {
    MatrixXd m(rows.size(), problem.rows());
    for (size_t i = 0; i < rows.size(); ++i) m.row(i) = -factors[i] * problem.S.row(rows[i]);
    return m;
  }
  VectorXd right(const ScaledFriction& problem) const {
    VectorXd v(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) v[i] = factors[i] * problem.q[rows[i]];
    return v;
  }
};

}  // namespace

bool may_contradict(const ScaledFriction& problem) {
  ConeProgram program;
  Rows equal, signs, cones;
  for (const auto& block : problem.blocks) {
    const int row = block.row;
    if (block.is_contact() && block.mu > 0 && block.tangents > 0) {
      cones.add(row, 1 / block.mu);
      for (int k = 1; k <= block.tangents; ++k) cones.add(row + k, 1);
      program.cones.push_back(block.size());
      continue;
    }
    const bool rises = block.is_contact() || std::isinf(block.high),
               falls = !block.is_contact() && std::isinf(block.low);
    if (rises && falls)
      equal.add(row, 1);
    else if (rises || falls)
      signs.add(row, rises ? 1 : -1);
  }
  program.c = VectorXd::Zero(problem.rows());
  program.A = equal.left(problem), program.b = equal.right(problem);
  program.nonnegative = static_cast<int>(signs.rows.size());
  for (size_t i = 0; i < cones.rows.size(); ++i) signs.add(cones.rows[i], cones.factors[i]);
  program.G = signs.left(problem), program.h = signs.right(problem);
  return solve(program).status == ConeStatus::infeasible;
}

}  // namespace clench
