#include "math/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

namespace clench {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::SelfAdjointEigenSolver;

Svd singular_value_decomposition(const MatrixXd& m) {
  const Eigen::JacobiSVD<MatrixXd> svd(m, Eigen::ComputeFullU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigensystem<MatrixXd, Eigen::VectorXd> eigensystem(const MatrixXd& m) {
  const SelfAdjointEigenSolver<MatrixXd> solver(m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigensystem<Matrix3d, Eigen::Vector3d> eigensystem(const Matrix3d& m) {
  const SelfAdjointEigenSolver<Matrix3d> solver(m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::Vector3d eigenvalues(const Matrix3d& symmetric) {
  return SelfAdjointEigenSolver<Matrix3d>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

bool is_positive_definite(const Matrix3d& m) {
  return Eigen::LLT<Matrix3d>(m).info() == Eigen::Success;
}

MatrixXd solve_symmetric(const MatrixXd& m, const MatrixXd& right) { return m.ldlt().solve(right); }

Eigen::Quaterniond least_turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double twice_cosine = (a + b).norm();  // of half the angle
  Eigen::Quaterniond turn;
  // opposite within half of a double's digits, their product is no axis
  const bool opposite = twice_cosine < 1e-8;
  turn.w() = twice_cosine / 2;
  turn.vec() = opposite ? a.unitOrthogonal() : Eigen::Vector3d(a.cross(b) / twice_cosine);
  return turn;
}

}  // namespace clench
