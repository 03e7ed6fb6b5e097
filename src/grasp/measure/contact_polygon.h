// The polygon that the contacts of a grasp span: how large and how even it is, and where it lies.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

/// The convex polygon of contact points in the plane that fits them best (least squares). Points
/// on the way between others are no corners.
struct ContactPolygon {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< mean of the points, in their frame [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< of the plane; either of the two
  std::vector<Eigen::Vector3d> corners;  ///< in order about the normal, in the plane [m]
  double area = 0;                       ///< [m^2]; 0 of points in a line
  /// How far the inner angles are from those of a regular polygon of as many corners, over the
  /// farthest that they can be: 0 regular .. 1 flat. 1 with fewer than three corners.
  double irregularity = 1;
};

/// points  at least one, finite; those within a micrometre of another count once
/// source  Roa & Suarez (2015), Grasp quality measures, sec. 2.2: shape and area of the grasp
///         polygon
ContactPolygon contact_polygon(const std::vector<Eigen::Vector3d>& points);

}  // namespace clench
