// Where two shapes touch: the points of all near triangle pairs, reduced to the outline of each
// patch.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/contact/feature.h"
#include "clench/geometry/query/queries.h"

namespace clench {

/// One point where surfaces come closer than the threshold; in the frame of a.
struct Touch {
  Eigen::Vector3d p_a, p_b;                ///< the two surface points [m]
  Eigen::Vector3d normal_b;                ///< unit, into b (from a towards b)
  double gap = 0;                          ///< [m]
  Feature feature_a = {}, feature_b = {};  ///< that the points lie on
};

struct TouchOptions {
  double threshold = 1e-4;  ///< surfaces closer than this touch [m]
  /// points of a patch nearer than this are one; at most 1/10 of the smaller radius [m]
  double merge_radius = 1e-3;
  int max_per_patch = 8;  ///< a longer outline is thinned, the closest pair kept
};

/// Points of a patch nearer than this are one [m].
double merge_radius(const Shape& a, const Shape& b, const TouchOptions& options);

/// Contact set of two shapes that do not intersect. A patch is where near points with one normal
/// hang together; it gives the corners of its outline, so a box standing on a table touches at four
/// points however its faces are cut into triangles. Always contains the closest pair (its gap to
/// the bit); never loses a patch. Normals run along the gap; where it is too narrow to tell a
/// direction, along the face's normal. Round pieces touch as their formulas say.
///
/// returns  nothing when they are farther apart than the threshold, intersect, or one holds the
///          other
/// throws   Error when an option is negative or not finite, or max_per_patch < 1
std::vector<Touch> contact_set(const Shape& a, const Shape& b, const Pose& X_AB,
                               const TouchOptions& options = {});

}  // namespace clench
