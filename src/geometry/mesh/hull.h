// Convex hulls in 2 to 6 dimensions, by qhull. The rank is determined first: the result for a flat
// set has its rank, and no facets.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

struct Hull {
  int dimension = 0;  ///< of the space: rows of the points
  /// of the affine hull of the points; there are facets only if rank == dimension
  int rank = 0;
  Eigen::MatrixXd normals;               ///< dimension x facets, unit, outward
  Eigen::VectorXd offsets;               ///< normal . x <= offset inside
  std::vector<std::vector<int>> facets;  ///< indices of points on each facet; simplices
  double volume = 0;
  double area = 0;

  bool full() const { return rank == dimension; }
};

/// points  dimension x count, finite; any count
/// throws  Error if a coordinate is not finite or dimension is outside 2..6
/// source  Barber, Dobkin & Huhdanpaa (1996)
Hull convex_hull(const Eigen::MatrixXd& points);

/// Triangles of the hull of points in space, by their indices, counter-clockwise from outside.
std::vector<Triangle> hull_triangles(const Hull& hull, const Eigen::MatrixXd& points);

/// Rank of the affine hull, by singular values relative to the largest.
int affine_rank(const Eigen::MatrixXd& points, double tolerance = 1e-10);

}  // namespace clench
