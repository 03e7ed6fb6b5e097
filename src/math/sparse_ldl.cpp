#include "clench/math/sparse_ldl.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <vector>

#include "clench/base/watched.h"

namespace clench {

// Eigen's factorization, bit-identical, that can be stopped.
// source  Davis (2005), Algorithm 849: a concise sparse Cholesky factorization package
class StoppableLdlt : public Eigen::SimplicialLDLT<SparseLdl::Matrix, Eigen::Lower> {
 public:
  void factor(const SparseLdl::Matrix& lower) {
    SparseLdl::Matrix upper(lower.rows(), lower.cols());
    upper.selfadjointView<Eigen::Upper>() = lower.selfadjointView<Eigen::Lower>().twistedBy(m_P);
    const auto size = static_cast<int>(upper.rows());
    m_diag.resize(size);
    row_.assign(size, 0.0), visited_.assign(size, -1), order_.resize(size);
    m_nonZerosPerCol.setZero();
    m_info = Eigen::Success;
    m_factorizationIsOk = true;
    StopCheck check(16);
    for (int k = 0; k < size && m_info == Eigen::Success; ++k) {
      check();
      find_row(k, gather(upper, k));
      if (m_diag[k] == 0) m_info = Eigen::NumericalIssue;
    }
  }

 private:
  // Loads row k of the matrix into row_, and lists the columns of L that it fills, so that each
  // comes after those that it depends on.
  // returns  the start of their list in order_
  int gather(const SparseLdl::Matrix& upper, int k) {
    int top = static_cast<int>(order_.size());
    visited_[k] = k;
    for (SparseLdl::Matrix::InnerIterator it(upper, k); it; ++it) {
      auto i = static_cast<int>(it.index());
      if (i > k) continue;
      row_[i] += it.value();
      // up the elimination tree
      int length = 0;
      for (; visited_[i] != k; i = m_parent[i]) order_[length++] = i, visited_[i] = k;
      while (length > 0) order_[--top] = order_[--length];
    }
    return top;
  }

  // row k of L and of D
  void find_row(int k, int top) {
    const int* begins = m_matrix.outerIndexPtr();
    int* rows = m_matrix.innerIndexPtr();
    double* values = m_matrix.valuePtr();
    double d = row_[k];
    row_[k] = 0;
    for (; top < static_cast<int>(order_.size()); ++top) {
      const int i = order_[top];
      const double y = row_[i], l = y / m_diag[i];
      row_[i] = 0;
      const int end = begins[i] + m_nonZerosPerCol[i]++;
      for (int at = begins[i]; at < end; ++at) row_[rows[at]] -= values[at] * y;
      d -= l * y;
      rows[end] = k, values[end] = l;
    }
    m_diag[k] = d;
  }

  std::vector<double> row_;
  std::vector<int> visited_, order_;
};

struct SparseLdl::Parts {
  StoppableLdlt solver;
};

SparseLdl::SparseLdl(const Matrix& lower) : parts_(std::make_unique<Parts>()) {
  parts_->solver.analyzePattern(lower);
}

SparseLdl::SparseLdl(SparseLdl&&) noexcept = default;
SparseLdl::~SparseLdl() = default;

bool SparseLdl::factor(const Matrix& lower) {
  parts_->solver.factor(lower);
  return parts_->solver.info() == Eigen::Success && parts_->solver.vectorD().allFinite();
}

Eigen::VectorXd SparseLdl::solve(const Eigen::VectorXd& right) const {
  return parts_->solver.solve(right);
}

}  // namespace clench
