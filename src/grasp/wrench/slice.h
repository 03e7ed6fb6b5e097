// Section of a convex set: the points with given values in some coordinates.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/grasp/wrench/support_set.h"

namespace clench {

/// Its support is that of a linear program over points of the set, which are generated as needed
/// (source  Dantzig & Wolfe (1960)): it ends after a few steps, since each query starts from the
/// last solution.
class Slice final : public SupportSet {
 public:
  /// set     of 2 to max_dimensions dimensions and size about one; must outlive this
  /// values  of its last coordinates, fewer than its dimension. Perturbed by up to 1e-11, so that
  ///         they do not lie on a face of the set
  Slice(const SupportSet& set, const Eigen::VectorXd& values);

  /// Does the set have points with these values? Otherwise support() must not be called.
  bool empty() const { return empty_; }
  int dimension() const override { return free_; }
  double support(const double* direction, double* point) const override;

 private:
  // Steps from corner to corner while `goal` increases: per coordinate of the set, and of
  // artificial points.
  double climb(const Eigen::VectorXd& goal, double stand_in) const;
  void enter(const Eigen::VectorXd& point, const Eigen::VectorXd& shares, int leaving) const;
  int leaving(const Eigen::VectorXd& shares) const;
  Eigen::VectorXd shares_of(const Eigen::VectorXd& point) const;

  const SupportSet& set_;
  int free_, fixed_;
  bool empty_ = false;
  Eigen::VectorXd expected_;  // the values, and the sum 1 of all weights
  // points whose weighted mean was the last support point; mutable as a cache
  mutable Eigen::MatrixXd corners_;  // of the set, one per column
  mutable Eigen::MatrixXd
      inverse_;  // of the matrix whose columns are a corner's fixed coordinates and 1
  mutable Eigen::VectorXd weights_;
  mutable std::vector<char> stands_in_;
};

}  // namespace clench
