// Nearest point of a convex set.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/grasp/wrench/support_set.h"

namespace clench {

struct NearestPoint {
  Eigen::VectorXd point;
  double distance = 0;
  /// points of the set, one per column, and their weights, > 0, whose mean is the nearest point
  Eigen::MatrixXd corners;
  std::vector<double> shares;
};

/// set     of 1 to max_dimensions dimensions and size about one
/// place   a point of the same dimension
/// noise   distances below it count as zero; also the tolerance of the result
/// source  Wolfe (1976), Finding the nearest point in a polytope
NearestPoint nearest_point(const SupportSet& set, const Eigen::VectorXd& place,
                           double noise = 1e-13);

}  // namespace clench
