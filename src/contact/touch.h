// A point where two shapes touch.
#pragma once
#include <Eigen/Core>

#include "clench/contact/feature.h"

namespace clench {

/// A point at which surfaces are closer than the threshold; in the frame of a.
struct Touch {
  Eigen::Vector3d p_a, p_b;                ///< the two surface points [m]
  Eigen::Vector3d normal_b;                ///< unit, into b (from a towards b)
  double gap = 0;                          ///< [m]
  Feature feature_a = {}, feature_b = {};  ///< features on which the points lie
};

struct TouchOptions {
  double threshold = 1e-4;  ///< surfaces closer than this touch [m]
  /// points of a patch nearer than this are merged; at most 1/10 of the smaller radius [m]
  double merge_radius = 1e-3;
  int max_per_patch = 8;  ///< longer outlines are thinned, the closest pair is kept
};

}  // namespace clench
