// The point of a convex set that is nearest to a place.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/grasp/wrench/support_set.h"

namespace clench {

struct NearestPoint {
  Eigen::VectorXd point;
  double distance = 0;
  /// points of the set, a column each, and their shares, > 0, that make up the nearest one
  Eigen::MatrixXd corners;
  std::vector<double> shares;
};

/// set     of 1 to max_dimensions dimensions and size about one
/// place   its dimension
/// noise   a distance that counts as none, and by how much the answer's may be off
/// source  Wolfe (1976), Finding the nearest point in a polytope
NearestPoint nearest_point(const SupportSet& set, const Eigen::VectorXd& place,
                           double noise = 1e-13);

}  // namespace clench
