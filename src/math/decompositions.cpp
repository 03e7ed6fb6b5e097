#include "clench/math/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/math/product.h"

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

namespace {

using Eigen::Index;

// Matrices of fewer rows are factored by Eigen in a few milliseconds.
constexpr Index few_rows = 512;

// Block width of Eigen's own factorizations, which have the same bits: an eighth of the rows, in
// multiples of 16.
Index block_width(Index rows, Index widest) {
  return std::clamp<Index>(rows / 8 / 16 * 16, 8, widest);
}

// The lower triangle of m minus that of b b^T: as computed by Eigen, in groups if that takes long.
void subtract_square(Eigen::Block<MatrixXd> m, const Eigen::Block<MatrixXd>& b) {
  constexpr double longest = 5e8;  // multiplications and additions: about 0.1 s
  constexpr Index width = 128;
  const Index size = m.rows();
  check_stop();
  if (static_cast<double>(size) * static_cast<double>(size) * static_cast<double>(b.cols()) <
      longest) {
    m.selfadjointView<Eigen::Lower>().rankUpdate(b, -1.0);
    return;
  }
  for (Index k = 0; k < size; k += width) {
    check_stop();
    const Index own = std::min(width, size - k), rest = size - k - own;
    m.block(k, k, own, own).selfadjointView<Eigen::Lower>().rankUpdate(b.middleRows(k, own), -1.0);
    m.block(k + own, k, rest, own).noalias() -=
        b.bottomRows(rest) * b.middleRows(k, own).transpose();
  }
}

// Replaces m by L of m = L L^T, in the same blocks as Eigen's LLT.
// returns  true if it is positive definite
bool cholesky_in_place(MatrixXd& m) {
  using Llt = Eigen::internal::llt_inplace<double, Eigen::Lower>;
  constexpr Index widest = 128;
  const Index size = m.rows();
  if (size < few_rows) return Llt::blocked(m) < 0;
  const Index width = block_width(size, widest);
  for (Index k = 0; k < size; k += width) {
    check_stop();
    const Index own = std::min(width, size - k), rest = size - k - own;
    auto diagonal = m.block(k, k, own, own);
    if (Llt::unblocked(diagonal) >= 0) return false;
    if (rest == 0) break;
    auto below = m.block(k + own, k, rest, own);
    diagonal.adjoint().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
    subtract_square(m.block(k + own, k + own, rest, rest), below);
  }
  return true;
}

// Replaces m by L and U of P m = L U, in the same blocks as Eigen's PartialPivLU.
// swaps  of rows, one after another
void lu_in_place(MatrixXd& m, Eigen::VectorXi& swaps) {
  using Lu = Eigen::internal::partial_lu_impl<double, Eigen::ColMajor, int>;
  constexpr Index widest = 256, widest_in_panel = 16;
  const Index size = m.rows();
  int ignored = 0;
  swaps.resize(size);
  if (size == 0) return;
  if (size < few_rows) {
    Lu::blocked_lu(size, size, m.data(), m.outerStride(), swaps.data(), ignored, widest);
    return;
  }
  const Index width = block_width(size, widest);
  for (Index k = 0; k < size; k += width) {
    check_stop();
    const Index own = std::min(width, size - k), rest = size - k - own;
    Lu::blocked_lu(size - k, own, &m(k, k), m.outerStride(), &swaps[k], ignored, widest_in_panel);
    for (Index i = k; i < k + own; ++i) {
      swaps[i] += static_cast<int>(k);
      m.row(i).head(k).swap(m.row(swaps[i]).head(k));
      m.row(i).tail(rest).swap(m.row(swaps[i]).tail(rest));
    }
    if (rest == 0) break;
    auto beside = m.block(k, k + own, own, rest);
    m.block(k, k, own, own).triangularView<Eigen::UnitLower>().solveInPlace(beside);
    const auto below = m.block(k + own, k, rest, own);
    in_column_parts(rest, rest, own, [&](Index first, Index count) {
      m.block(k + own, k + own + first, rest, count).noalias() -=
          below * beside.middleCols(first, count);
    });
  }
}

}  // namespace

struct DenseLu::Parts {
  MatrixXd lu;
  Eigen::VectorXi swaps;
};

DenseLu::DenseLu() : parts_(std::make_unique<Parts>()) {}
DenseLu::~DenseLu() = default;

void DenseLu::factor(const MatrixXd& m) {
  parts_->lu = m;
  lu_in_place(parts_->lu, parts_->swaps);
}

Eigen::VectorXd DenseLu::solve(const Eigen::VectorXd& right) const {
  Eigen::VectorXd x = right;
  for (Index i = 0; i < x.size(); ++i) std::swap(x[i], x[parts_->swaps[i]]);
  parts_->lu.triangularView<Eigen::UnitLower>().solveInPlace(x);
  parts_->lu.triangularView<Eigen::Upper>().solveInPlace(x);
  return x;
}

struct DenseCholesky::Parts {
  MatrixXd l;
};

DenseCholesky::DenseCholesky() : parts_(std::make_unique<Parts>()) {}
DenseCholesky::~DenseCholesky() = default;

bool DenseCholesky::factor(const MatrixXd& m) {
  parts_->l = m;
  return cholesky_in_place(parts_->l);
}

Eigen::VectorXd DenseCholesky::solve(const Eigen::VectorXd& right) const {
  Eigen::VectorXd x = right;
  parts_->l.triangularView<Eigen::Lower>().solveInPlace(x);
  parts_->l.adjoint().triangularView<Eigen::Upper>().solveInPlace(x);
  return x;
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
  // opposite within half of a double's digits: their product defines no axis
  const bool opposite = twice_cosine < 1e-8;
  turn.w() = twice_cosine / 2;
  turn.vec() = opposite ? a.unitOrthogonal() : Eigen::Vector3d(a.cross(b) / twice_cosine);
  return turn;
}

}  // namespace clench
