// Linear systems of some dozen unknowns, factored in place.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

/// Memory is kept from one system to the next.
class DenseSystem {
 public:
  /// To be filled with the n x n matrix; factor() overwrites it.
  Eigen::MatrixXd& matrix(int n);
  /// symmetric  then the lower triangle counts, and the matrix must be positive definite
  /// returns    false where a pivot is 0, or not positive, or not finite
  /// source     Golub & Van Loan (2013), Matrix Computations, 3.2.9 and 4.2.5: by columns, pivots by rows
  bool factor(bool symmetric);
  void solve(Eigen::VectorXd& right) const;

 private:
  bool factor_symmetric();
  bool factor_general();

  Eigen::MatrixXd m_;
  std::vector<int> pivots_;
  std::vector<double> inverse_;  // of pivots
  bool symmetric_ = true;
};

}  // namespace clench
