#include "support/linear.h"

#include <Eigen/LU>

#include "clench/math/decompositions.h"

namespace clench::test {

Eigen::MatrixXd random_turn(int d, Random& random) {
  Eigen::MatrixXd m(d, d);
  for (double& x : m.reshaped()) x = random.normal();
  return singular_value_decomposition(m).u;
}

std::optional<Eigen::VectorXd> common_normal(const Eigen::MatrixXd& m) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(m);
  if (lu.dimensionOfKernel() != 1) return {};
  return lu.kernel().col(0).normalized();
}

Solutions solutions(const Eigen::MatrixXd& m, const Eigen::VectorXd& right) {
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(m);
  return {lu.kernel(), lu.solve(right)};
}

double determinant(const Eigen::MatrixXd& m) {
  return Eigen::FullPivLU<Eigen::MatrixXd>(m).determinant();
}

}  // namespace clench::test
