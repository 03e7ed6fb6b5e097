// The linear system of an interior-point method over cones.
#pragma once
#include <Eigen/SparseCore>
#include <optional>

#include "clench/math/cones.h"
#include "clench/math/decompositions.h"
#include "clench/math/sparse_ldl.h"

namespace clench {

/// min 1/2 x.P x + q.x with rows A x + s = b: the first `equal` rows with s = 0, followed by the
/// cones
struct ConeRows {
  Eigen::SparseMatrix<double> P, A, At;
  Eigen::VectorXd q, b;
  int equal = 0;
  ConeSizes cones;
  std::vector<int> cone_at;  // index of the cone of each cone row

  int unknowns() const { return static_cast<int>(q.size()); }
  int count() const { return static_cast<int>(b.size()); }
  int in_cones() const { return count() - equal; }
};

/// [P A^T; A -W^2], with the rows of the cones divided by W and their unknowns multiplied by W: [P
/// A^T W^-1; W^-1 A -1]. This keeps it well conditioned up to the end. W is 0 in the equations.
class ConeKkt {
 public:
  explicit ConeKkt(const ConeRows& rows);
  /// rows and scaling must outlive the solutions
  /// returns  false if the factorization fails
  bool factor(const NesterovTodd& scaling);
  /// right and left in the original rows and unknowns; iterative refinement removes the effect of
  /// the regularization
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  struct Solution {
    Eigen::VectorXd value;
    double off = 0;  // largest residual
  };
  template <class Solver>
  Solution refined(const Eigen::VectorXd& right, Solver solver) const;
  void fill(double extra);
  void scale_column(int k, double* end);
  Eigen::VectorXd times(const Eigen::VectorXd& v) const;
  const DenseLu& lu() const;

  const ConeRows& rows_;
  SparseLdl::Matrix lower_;
  SparseLdl ldl_;
  mutable std::optional<DenseLu> lu_;
  const NesterovTodd* scaling_ = nullptr;
};

}  // namespace clench
