// Round solids given by closed formulas. Contacts and rolling use the formulas; pictures, masses
// and rays use the triangles of the mesh.
#pragma once
#include <Eigen/Core>

#include "clench/math/pose.h"

namespace clench {

/// A convex solid about the origin of its own frame, with its axis along z.
struct Round {
  enum Kind {
    capsule,   ///< points within radii.x of the segment from z = -half to half; half 0: a ball
    cylinder,  ///< of radius radii.x, from z = -half to half
    ellipsoid  ///< of semi-axes radii
  };
  Kind kind = capsule;
  Eigen::Vector3d radii = Eigen::Vector3d::Zero();  ///< > 0 if used, otherwise 0 [m]
  double half = 0;                                  ///< >= 0; 0 for an ellipsoid [m]

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

/// A segment about the origin along an axis of a solid: the solid contains the segment, and all
/// points of the solid lie within `around` of it.
struct Core {
  Eigen::Vector3d end = Eigen::Vector3d::Zero();  ///< the other end is -end [m]
  double around = 0;                              ///< [m]
};
Core core_of(const Round& round);

/// A round solid, and the triangles of a mesh that represent it.
struct RoundPiece {
  Round solid;
  Pose X_SR;  ///< frame of the solid in that of the shape
  /// of its triangles: the first index, and the number of consecutive triangles
  int first = 0, count = 0;
};

/// The radius of the largest ball inside [m].
double inner_radius(const Round& round);

/// The nearest point of the surface, by distance and normal.
struct NearSkin {
  double distance = 0;     ///< negative inside [m]
  Eigen::Vector3d normal;  ///< unit, outward, at the nearest point of the surface
};

/// The surface point nearest to p [m], in the solid's frame. The distance is convex in p, and the
/// normal is its gradient; if several points of the surface are nearest, the normal of one of them.
///
/// source  D. Eberly (2013), "Distance from a Point to an Ellipse, an Ellipsoid, or a
///         Hyperellipsoid", for ellipsoids
NearSkin nearest(const Round& round, const Eigen::Vector3d& p);

/// The point farthest along a unit direction [m], in the solid's frame; if a segment or a disc is
/// equally far, its middle.
Eigen::Vector3d support(const Round& round, const Eigen::Vector3d& direction);

/// The flat part of a solid's surface that is farthest along a direction: a point, a segment or a
/// disc, and how much of it is near its farthest point.
struct FlatPart {
  enum Kind { point, segment, disc };
  Kind kind = point;
  Eigen::Vector3d middle;                              ///< [m]
  Eigen::Vector3d half = Eigen::Vector3d::Zero();      ///< of a segment, to one end [m]
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), y = x;  ///< of a disc, to its rim [m]
  double low = -1, high = 1;  ///< near are the points middle + s half with s from low to high
  double cut = -1;            ///< near are the points middle + s x + t y with s >= cut
};

/// Height of the near part of a flat part whose points differ by `drop` in height, with `slack`
/// left below the contact threshold: all of it if the drop is no more than the slack, less for
/// steeper parts, and none if a quarter or less of the drop is within the slack, so that a body
/// that rocks or rolls that steeply touches at a point [m].
double near_height(double slack, double drop);

/// In the solid's frame. The x of a disc points to the farthest point of its rim. A point if no
/// flat part lies within 30 degrees of the direction, or nothing of it is near.
/// direction  unit
/// slack      > 0, maximum by which near points may lie less far along the direction, as in
///            near_height(); infinite: all of the flat part is near [m]
FlatPart flat_part(const Round& round, const Eigen::Vector3d& direction, double slack);

}  // namespace clench
