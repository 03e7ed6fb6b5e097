// Nearest points of a round solid and a segment, a triangle or another round solid.
#pragma once
#include <limits>

#include "clench/geometry/query/triangle.h"
#include "clench/geometry/round/round.h"

namespace clench {

/// A point near a round solid, in the frame in which the solid is placed.
struct NearPlace {
  double distance = std::numeric_limits<double>::infinity();  ///< negative inside the solid [m]
  Eigen::Vector3d point;                                      ///< the point [m]
  Eigen::Vector3d normal;  ///< unit, of the solid's surface, towards the point
};

/// A round solid in the frame of the shape that it is compared with.
struct PlacedRound {
  Round solid;
  Pose X;  ///< frame of the solid in that frame

  NearPlace nearest_to(const Eigen::Vector3d& p) const {
    const NearSkin skin = nearest(solid, X.inverse() * p);
    return {skin.distance, p, X.rotation * skin.normal};
  }
  Eigen::Vector3d center() const { return X.position; }
  /// the point farthest along a unit direction
  Eigen::Vector3d farthest(const Eigen::Vector3d& direction) const {
    return X * support(solid, X.rotation.conjugate() * direction);
  }
};

/// The point of the segment from p to q with the smallest distance.
NearPlace nearest_on_segment(const PlacedRound& round, const Eigen::Vector3d& p,
                             const Eigen::Vector3d& q);

/// The same for a triangle. If the triangle passes through the solid, the point is inside the
/// solid.
NearPlace nearest_on_triangle(const PlacedRound& round, const Corners& triangle);

/// The gap between two round solids a and b.
struct RoundGap {
  /// of the surfaces, to 1e-9 of their size; if the solids overlap, minus the depth [m]
  double gap = 0;
  Eigen::Vector3d p_a, p_b;  ///< the nearest points, on both surfaces [m]
  Eigen::Vector3d normal;    ///< unit, from a into b
};
RoundGap gap_between(const PlacedRound& a, const PlacedRound& b);

}  // namespace clench
