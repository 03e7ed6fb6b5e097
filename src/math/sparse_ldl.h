// Symmetric systems that are mostly zeros: positive definite in some unknowns, negative in the
// others.
#pragma once
#include <Eigen/SparseCore>
#include <memory>

namespace clench {

/// m = L D L^T after a reordering that keeps L sparse; it exists for every quasi-definite m,
/// without pivots.
/// source  Vanderbei (1995), Symmetric quasidefinite matrices
class SparseLdl {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  /// lower  triangle; its pattern is that of all matrices to come
  explicit SparseLdl(const Matrix& lower);
  SparseLdl(SparseLdl&&) noexcept;
  ~SparseLdl();
  /// returns  false when a pivot is 0 or not finite
  bool factor(const Matrix& lower);
  /// after a factor() that succeeded
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace clench
