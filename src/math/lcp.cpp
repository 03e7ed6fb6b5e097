#include "clench/math/lcp.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "clench/base/watched.h"
#include "clench/math/decompositions.h"

namespace clench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// entries of a column that count as 0, relative to its largest; ratios that differ by less are ties
constexpr double zero = 1e-11, tie = 1e-12;

/// The rows  basic + (inverse of the basis) (w - M z - z0) = right;  columns: w, z, z0, right.
class Tableau {
 public:
  Tableau(const MatrixXd& M, const VectorXd& q)
      : n_(static_cast<int>(q.size())), rows_(n_, 2 * n_ + 2), basis_(n_) {
    rows_.leftCols(n_).setIdentity();
    rows_.middleCols(n_, n_) = -M;
    rows_.col(2 * n_).setConstant(-1);
    rows_.col(2 * n_ + 1) = q;
    for (int i = 0; i < n_; ++i) basis_[i] = i;
  }
  int z0() const { return 2 * n_; }
  int basic(int row) const { return basis_[row]; }
  int complement(int variable) const { return variable < n_ ? variable + n_ : variable - n_; }

  /// The row at which z0 enters: the lexicographically smallest.
  int first_row() const {
    int best = 0;
    for (int i = 1; i < n_; ++i)
      if (less(i, -1, best, -1)) best = i;
    return best;
  }
  /// The row whose variable first becomes 0 as the entering variable increases; -1: none.
  int leaving_row(int entering) const {
    const double least = zero * rows_.col(entering).cwiseAbs().maxCoeff();
    int best = -1;
    for (int i = 0; i < n_; ++i) {
      const double pivot = rows_(i, entering);
      if (!(pivot > least)) continue;
      if (best < 0 || less(i, pivot, best, rows_(best, entering))) best = i;
    }
    if (best < 0) return best;
    // among equal ratios, z0, which ends the iterations
    const double ratio = rows_(best, 2 * n_ + 1) / rows_(best, entering);
    for (int i = 0; i < n_; ++i) {
      const double pivot = rows_(i, entering);
      if (basis_[i] == z0() && pivot > least &&
          rows_(i, 2 * n_ + 1) / pivot <= ratio + tie * (1 + std::abs(ratio)))
        return i;
    }
    return best;
  }
  /// returns  the variable that leaves
  int pivot(int row, int entering) {
    rows_.row(row) /= rows_(row, entering);
    StopCheck check(64);
    for (int i = 0; i < n_; ++i) {
      check();
      const double factor = rows_(i, entering);
      if (i != row && factor != 0) rows_.row(i) -= factor * rows_.row(row);
    }
    // rounding error of a 0
    double& right = rows_(row, 2 * n_ + 1);
    if (std::abs(right) < 1e-15) right = 0;
    return std::exchange(basis_[row], entering);
  }

 private:
  // is row a divided by its pivot less than row b by its pivot, in the first number in which they
  // differ?
  bool less(int a, double pivot_a, int b, double pivot_b) const {
    const double sign = pivot_a < 0 ? -1 : 1;
    pivot_a *= sign, pivot_b *= sign;
    const auto compare = [&](int column) {
      const double x = rows_(a, column) / pivot_a, y = rows_(b, column) / pivot_b;
      return std::abs(x - y) <= tie * (1 + std::abs(x) + std::abs(y)) ? 0 : x < y ? -1 : 1;
    };
    int order = compare(2 * n_ + 1);
    for (int k = 0; k < n_ && order == 0; ++k) order = compare(k);
    return order < 0;
  }

  int n_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows_;
  std::vector<int> basis_;
};

/// z of a complementary basis, from M and q themselves, without the rounding errors of the pivots.
VectorXd solve_basis(const MatrixXd& M, const VectorXd& q, const std::vector<int>& basic) {
  const int n = static_cast<int>(basic.size());
  MatrixXd part(n, n);
  VectorXd right(n);
  for (int i = 0; i < n; ++i) {
    right[i] = -q[basic[i]];
    for (int j = 0; j < n; ++j) part(i, j) = M(basic[i], basic[j]);
  }
  VectorXd z = VectorXd::Zero(q.size());
  if (n == 0) return z;
  const DenseLu lu(part);
  VectorXd some = lu.solve(right);
  some += lu.solve(right - part * some);
  for (int i = 0; i < n; ++i) z[basic[i]] = std::max(some[i], 0.0);
  return z;
}

}  // namespace

LcpSolution solve_lcp(const MatrixXd& M, const VectorXd& q, int max_iterations) {
  const int n = static_cast<int>(q.size());
  LcpSolution solution{.z = VectorXd::Zero(n)};
  if (n == 0 || q.minCoeff() >= 0) {
    solution.status = LcpStatus::solved;
    return solution;
  }
  if (max_iterations == 0) max_iterations = 200 + 50 * n;
  Tableau tableau(M, q);
  int entering = tableau.complement(tableau.pivot(tableau.first_row(), tableau.z0()));
  for (; solution.iterations < max_iterations; ++solution.iterations) {
    check_stop();
    const int row = tableau.leaving_row(entering);
    if (row < 0) {
      solution.status = LcpStatus::ray;
      return solution;
    }
    const int left = tableau.pivot(row, entering);
    if (left == tableau.z0()) {
      std::vector<int> basic;
      for (int i = 0; i < n; ++i)
        if (tableau.basic(i) >= n) basic.push_back(tableau.basic(i) - n);
      std::sort(basic.begin(), basic.end());
      solution.z = solve_basis(M, q, basic);
      if (solution.z.allFinite())
        solution.status = LcpStatus::solved;
      else
        solution.z.setZero();
      return solution;
    }
    entering = tableau.complement(left);
  }
  return solution;
}

}  // namespace clench
