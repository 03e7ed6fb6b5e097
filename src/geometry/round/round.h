// Round solids as their formulas give them: they touch and roll as what they are, while the
// triangles that stand for them are seen, weighed and hit by rays.
#pragma once
#include <Eigen/Core>

#include "clench/math/pose.h"

namespace clench {

/// A convex solid about the origin of its own frame, with its axis along z.
struct Round {
  enum Kind {
    capsule,   ///< all within radii.x of the segment from z = -half to half; half 0: a ball
    cylinder,  ///< of radius radii.x, from z = -half to half
    ellipsoid  ///< of semi-axes radii
  };
  Kind kind = capsule;
  Eigen::Vector3d radii = Eigen::Vector3d::Zero();  ///< > 0 where used, else 0 [m]
  double half = 0;                                  ///< >= 0; 0 of an ellipsoid [m]

  static Round ball(double radius) { return {capsule, {radius, 0, 0}, 0}; }
  static Round capsule_of(double radius, double length) {
    return {capsule, {radius, 0, 0}, length / 2};
  }
  static Round cylinder_of(double radius, double length) {
    return {cylinder, {radius, 0, 0}, length / 2};
  }
  static Round ellipsoid_of(const Eigen::Vector3d& radii) { return {ellipsoid, radii, 0}; }
  bool is_ball() const { return kind == capsule && half == 0; }
  bool operator==(const Round&) const = default;
};

inline constexpr const char* round_kinds[] = {"capsule", "cylinder", "ellipsoid"};

/// A solid is the segment of its long axis, along `axis`, and what lies within `around` of it, or
/// less.
struct Core {
  Eigen::Vector3d end = Eigen::Vector3d::Zero();  ///< the other end is -end [m]
  double around = 0;                              ///< [m]
};
Core core_of(const Round& round);

/// A round solid that triangles of a mesh stand for.
struct RoundPiece {
  Round solid;
  Pose X_SR;                 ///< its frame in the shape's
  int first = 0, count = 0;  ///< of the triangles
};

/// The radius of the largest ball inside [m].
double inner_radius(const Round& round);

/// The surface nearest to a point.
struct NearSkin {
  double distance = 0;     ///< negative inside [m]
  Eigen::Vector3d normal;  ///< unit, outward, where the surface is nearest
};

/// Of a point in the solid's frame. The distance is convex in p, and the normal its gradient; where
/// several points are nearest it is the normal of one of them.
///
/// source  D. Eberly (2013), "Distance from a Point to an Ellipse, an Ellipsoid, or a
///         Hyperellipsoid", for ellipsoids
NearSkin nearest(const Round& round, const Eigen::Vector3d& p);

/// The point farthest along a unit direction, in the solid's frame; where a segment or a disc is
/// equally far, its middle.
Eigen::Vector3d support(const Round& round, const Eigen::Vector3d& direction);

/// All that lies not more than `slack` [m] below the farthest point along a direction, as far as
/// it is flat: a point, or a segment between two, or a disc.
struct FlatPart {
  enum Kind { point, segment, disc };
  Kind kind = point;
  Eigen::Vector3d middle;                              ///< [m]
  Eigen::Vector3d half = Eigen::Vector3d::Zero();      ///< of a segment, to one end [m]
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), y = x;  ///< of a disc, to its rim [m]
};

/// In the solid's frame. The x of a disc points where it lies lowest.
FlatPart flat_part(const Round& round, const Eigen::Vector3d& direction, double slack);

}  // namespace clench
