// Near points of two surfaces: a corner over a face, an edge across an edge. The complete near part
// of both surfaces lies between them, so their outline is its outline.
#pragma once
#include <vector>

#include "clench/contact/feature.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"

namespace clench {

struct NearPoint {
  Eigen::Vector3d p_a, p_b;      ///< on both surfaces, frame of a [m]
  Eigen::Vector3d normal;        ///< unit, from a into b
  double gap = 0;                ///< [m]
  Feature feature_a, feature_b;  ///< parts of the shapes on which the points lie
  int region = 0;                ///< equal if a path of near points leads from one to the other
};

/// The closest pair first, then the others in the order of the triangles. Only points at which each
/// surface is the nearest to the other within its neighborhood, up to a slope of 1/30: not the
/// corners of a face that is tilted by more.
///
/// pairs      of pairs_within(a, b, X_AB, threshold); not empty, none intersecting
/// threshold  [m]
std::vector<NearPoint> near_points(const Shape& a, const Shape& b, const Pose& X_AB,
                                   const std::vector<TrianglePair>& pairs, double threshold);

/// Rounding error of a difference of points of two shapes [m].
double coordinate_rounding(const Shape& a, const Shape& b, const Pose& X_AB);

/// Normal of a triangle by its winding; 0 for a triangle without area.
Eigen::Vector3d face_normal(const Corners& corners);

}  // namespace clench
