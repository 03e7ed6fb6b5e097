#include "clench/math/nonnegative_least_squares.h"

#include <vector>

#include "clench/base/watched.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// least squares over the columns in use, 0 for the others
VectorXd solve_free(const MatrixXd& a, const VectorXd& b, const std::vector<int>& used) {
  MatrixXd columns(a.rows(), static_cast<int>(used.size()));
  for (size_t i = 0; i < used.size(); ++i) columns.col(static_cast<int>(i)) = a.col(used[i]);
  const VectorXd inner = least_squares(columns, b);
  VectorXd x = VectorXd::Zero(a.cols());
  for (size_t i = 0; i < used.size(); ++i) x[used[i]] = inner[static_cast<int>(i)];
  return x;
}

// as far from x towards z as all columns in use stay nonnegative; those that become 0 are removed
VectorXd step_towards(const VectorXd& x, const VectorXd& z, std::vector<int>& used) {
  double far = 1;
  for (const int i : used)
    if (z[i] <= 0) far = std::min(far, x[i] / (x[i] - z[i]));
  VectorXd out = x + far * (z - x);
  std::erase_if(used, [&](int i) {
    const bool gone = z[i] <= 0 && x[i] <= far * (x[i] - z[i]) * (1 + 1e-12);
    if (gone) out[i] = 0;
    return gone;
  });
  return out;
}

}  // namespace

VectorXd nonnegative_least_squares(const MatrixXd& a, const VectorXd& b, double tolerance) {
  VectorXd x = VectorXd::Zero(a.cols());
  std::vector<int> used;
  std::vector<bool> refused(a.cols(), false);  // only rounding made them seem useful
  const VectorXd lengths = a.colwise().norm();
  // each round adds one column; the known worst cases need a few rounds per column
  for (int round = 0; round < 10 * a.cols(); ++round) {
    check_stop();
    const VectorXd slope = a.transpose() * (b - a * x);
    int best = -1;
    double steepest = tolerance * b.norm();
    for (int i = 0; i < a.cols(); ++i)
      if (!refused[i] && x[i] == 0 && lengths[i] > 0 && slope[i] / lengths[i] > steepest)
        best = i, steepest = slope[i] / lengths[i];
    if (best < 0) break;
    std::vector<int> tried = used;
    tried.push_back(best);
    VectorXd z = solve_free(a, b, tried);
    if (!z.allFinite() || z[best] <= 0) {
      refused[best] = true;
      continue;
    }
    std::fill(refused.begin(), refused.end(), false);
    used = std::move(tried);
    while (!used.empty() && VectorXd(z(used)).minCoeff() <= 0) {
      check_stop();
      x = step_towards(x, z, used);
      if (!used.empty()) z = solve_free(a, b, used);
    }
    x = used.empty() ? VectorXd::Zero(a.cols()).eval() : z;
  }
  return x;
}

}  // namespace clench
