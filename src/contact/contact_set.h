// Where two shapes touch: the points of all near triangle pairs, reduced to the outline of each patch.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "geometry/queries.h"

namespace clench {

/// One point where surfaces come closer than the threshold; in the frame of a.
struct Touch {
  Eigen::Vector3d p_a, p_b;   ///< the two surface points [m]
  Eigen::Vector3d normal_b;   ///< unit, into b (from a towards b)
  double gap = 0;             ///< [m]
};

struct TouchOptions {
  double threshold = 1e-4;    ///< surfaces closer than this touch [m]
  double merge_radius = 3e-3; ///< points of a patch nearer than this are one [m]
  int most_per_patch = 8;     ///< a longer outline is thinned, the closest pair kept
};

/// Contact set of two shapes that do not intersect. Always contains the closest pair; never loses a patch.
/// returns empty when they are farther apart than the threshold, or intersect
std::vector<Touch> contact_set(const Shape& a, const Shape& b, const Pose& X_AB, const TouchOptions& options = {});

}  // namespace clench
