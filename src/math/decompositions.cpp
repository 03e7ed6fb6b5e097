#include "clench/math/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
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

MatrixXd solve_symmetric(const MatrixXd& m, const MatrixXd& right) { return m.ldlt().solve(right); }

Eigen::VectorXd least_squares(const MatrixXd& m, const Eigen::VectorXd& right) {
  return m.colPivHouseholderQr().solve(right);
}

struct DenseLu::Parts {
  Eigen::PartialPivLU<MatrixXd> lu;
};

DenseLu::DenseLu() : parts_(std::make_unique<Parts>()) {}
DenseLu::~DenseLu() = default;
void DenseLu::factor(const MatrixXd& m) { parts_->lu.compute(m); }

Eigen::VectorXd DenseLu::solve(const Eigen::VectorXd& right) const {
  return parts_->lu.solve(right);
}

struct DenseCholesky::Parts {
  Eigen::LLT<MatrixXd> llt;
};

DenseCholesky::DenseCholesky() : parts_(std::make_unique<Parts>()) {}
DenseCholesky::~DenseCholesky() = default;

bool DenseCholesky::factor(const MatrixXd& m) {
  parts_->llt.compute(m);
  return parts_->llt.info() == Eigen::Success;
}

Eigen::VectorXd DenseCholesky::solve(const Eigen::VectorXd& right) const {
  return parts_->llt.solve(right);
}

IndependentRows independent_rows(const MatrixXd& m, double tolerance) {
  IndependentRows out;
  const int count = static_cast<int>(m.rows());
  if (count == 0) return out;
  Eigen::Index rank = 0;
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  if (m.cols() > 0) {
    qr.setThreshold(tolerance);
    qr.compute(m.transpose());
    rank = qr.rank();
  }
  std::vector<Eigen::Index> place(count);  // of a row among the pivots
  for (int k = 0; k < count; ++k) place[m.cols() > 0 ? qr.colsPermutation().indices()[k] : k] = k;
  for (int row = 0; row < count; ++row) (place[row] < rank ? out.rows : out.others).push_back(row);
  const Eigen::Index others = count - rank;
  out.weights = MatrixXd::Zero(others, rank);
  if (rank == 0 || others == 0) return out;
  // the others are R12 in the basis in which the rows are R11
  const auto R = qr.matrixR().topRows(rank);
  MatrixXd weights = R.rightCols(others);
  R.leftCols(rank).triangularView<Eigen::Upper>().solveInPlace(weights);
  for (int i = 0; i < others; ++i)
    for (int j = 0; j < rank; ++j)
      out.weights(i, j) = weights(place[out.rows[j]], place[out.others[i]] - rank);
  return out;
}

Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
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
