// Sparse symmetric systems that are positive definite in some unknowns, negative definite in the
// others.
#pragma once
#include <Eigen/SparseCore>
#include <memory>

namespace clench {

/// m = L D L^T after a reordering that keeps L sparse; it exists for every quasi-definite m,
/// without pivoting.
/// source  Vanderbei (1995), Symmetric quasidefinite matrices
class SparseLdl {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  /// lower  triangle; all later matrices must have its pattern
  explicit SparseLdl(const Matrix& lower);
  SparseLdl(SparseLdl&&) noexcept;
  ~SparseLdl();
  /// returns  false if a pivot is 0 or not finite
  bool factor(const Matrix& lower);
  /// after a factor() that succeeded
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace clench
