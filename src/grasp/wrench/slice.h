// A section of a convex set: the points that have given values in some coordinates.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/grasp/wrench/support_set.h"

namespace clench {

/// Its support is that of a linear program over points of the set, found one by one as they are
/// needed (source  Dantzig & Wolfe (1960)): it ends after a few steps, since each starts from the
/// answer before.
class Slice final : public SupportSet {
 public:
  /// set     of 2 to max_dimensions dimensions and size about one; must outlive this
  /// values  what its last coordinates are to be, fewer than it has. Taken to within 1e-11, so that
  ///         they lie on no face of the set by chance
  Slice(const SupportSet& set, const Eigen::VectorXd& values);

  /// Has the set points with these values? Without any, there is no support to ask for.
  bool empty() const { return empty_; }
  int dimension() const override { return free_; }
  double support(const double* direction, double* point) const override;

 private:
  // Steps from corner to corner while `goal` grows: per coordinate of the set, and of points that
  // only stand in.
  double climb(const Eigen::VectorXd& goal, double stand_in) const;
  void enter(const Eigen::VectorXd& point, const Eigen::VectorXd& shares, int leaving) const;
  int leaving(const Eigen::VectorXd& shares) const;
  Eigen::VectorXd shares_of(const Eigen::VectorXd& point) const;

  const SupportSet& set_;
  int free_, fixed_;
  bool empty_ = false;
  Eigen::VectorXd expected_;  // the values, and that all weights sum to one
  // points whose weighted mean is where the last support was; mutable as a memory of it
  mutable Eigen::MatrixXd corners_;  // of the set, a column each
  mutable Eigen::MatrixXd
      inverse_;  // of the matrix whose columns are a corner's fixed coordinates and 1
  mutable Eigen::VectorXd weights_;
  mutable std::vector<char> stands_in_;
};

}  // namespace clench
