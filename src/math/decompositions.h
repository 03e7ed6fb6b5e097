// Decompositions that take Eigen long to compile, compiled once.
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

/// m  symmetric; only its lower triangle is read
Eigensystem<Eigen::MatrixXd, Eigen::VectorXd> eigensystem(const Eigen::MatrixXd& m);
Eigensystem<Eigen::Matrix3d, Eigen::Vector3d> eigensystem(const Eigen::Matrix3d& m);
/// ascending
Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& symmetric);

/// x of m x = right.
/// m  symmetric and positive definite
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& m, const Eigen::MatrixXd& right);

/// Minimizer x of |m x - right| for linearly independent columns of m; with dependent columns, one
/// of the minimizers.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& m, const Eigen::VectorXd& right);

/// x of m x = right, for many right sides. Factoring again reuses memory.
class DenseLu {
 public:
  DenseLu();
  explicit DenseLu(const Eigen::MatrixXd& m) : DenseLu() { factor(m); }
  ~DenseLu();
  /// m  square; if it is singular, solutions are not finite or inaccurate
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
  /// m        only its lower triangle is read
  /// returns  false: it is not positive definite
  bool factor(const Eigen::MatrixXd& m);
  /// after a factor that returned true
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// others = weights * rows, as rows of m; `rows` are linearly independent.
struct IndependentRows {
  std::vector<int> rows, others;  ///< ascending
  Eigen::MatrixXd weights;        ///< others x rows
};

/// A row whose distance from the span of others is within `tolerance`, relative to the largest row,
/// is dependent on them.
/// m  finite
IndependentRows independent_rows(const Eigen::MatrixXd& m, double tolerance);

/// The smallest rotation that maps one direction to another; for opposite ones, any of the half
/// turns.
Eigen::Quaterniond shortest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace clench
