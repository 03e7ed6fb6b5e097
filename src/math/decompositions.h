// What takes longest to compile of all that Eigen has, compiled once.
#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <vector>

namespace clench {

/// m = u * diag(values) * v^T, values descending.
struct Svd {
  Eigen::MatrixXd u;       ///< rows x rows, orthonormal
  Eigen::VectorXd values;  ///< min(rows, columns)
  Eigen::MatrixXd v;       ///< columns x min(rows, columns), orthonormal columns
};

/// m  at least one row and one column, finite
Svd singular_value_decomposition(const Eigen::MatrixXd& m);

/// m = vectors * diag(values) * vectors^T, values ascending.
template <class Matrix, class Vector>
struct Eigensystem {
  Vector values;
  Matrix vectors;  ///< orthonormal columns
};

/// m  symmetric; its lower triangle counts
Eigensystem<Eigen::MatrixXd, Eigen::VectorXd> eigensystem(const Eigen::MatrixXd& m);
Eigensystem<Eigen::Matrix3d, Eigen::Vector3d> eigensystem(const Eigen::Matrix3d& m);
/// ascending
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric);

/// x of m x = right.   m  symmetric and positive definite
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& m, const Eigen::MatrixXd& right);

/// x of least |m x - right|, where m's columns are independent; dependent ones share as the pivots
/// fall.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& m, const Eigen::VectorXd& right);

/// x of m x = right, for many right sides. Factoring again reuses the memory.
class DenseLu {
 public:
  DenseLu();
  explicit DenseLu(const Eigen::MatrixXd& m) : DenseLu() { factor(m); }
  ~DenseLu();
  /// m  square; where it is singular, solutions are not finite or far off
  void factor(const Eigen::MatrixXd& m);
  /// after factor
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The same for symmetric positive definite matrices.
class DenseCholesky {
 public:
  DenseCholesky();
  ~DenseCholesky();
  /// m        its lower triangle counts
  /// returns  false: it is not positive definite
  bool factor(const Eigen::MatrixXd& m);
  /// after a factor that returned true
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// others = weights * rows, as rows of m; `rows` are independent.
struct IndependentRows {
  std::vector<int> rows, others;  ///< ascending
  Eigen::MatrixXd weights;        ///< others x rows
};

/// A row within `tolerance` of the span of others, of the largest row, depends on them.   m  finite
IndependentRows independent_rows(const Eigen::MatrixXd& m, double tolerance);

/// The least turn that brings one direction to another; between opposite ones, any of the half
/// turns.
Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace clench
