// The polygon of the contacts of a grasp: its area, regularity and position.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

/// The convex polygon of contact points in their least-squares plane. Points on the line between
/// others are no corners.
struct ContactPolygon {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< mean of the points, in their frame [m]
  /// of the plane; either of the two directions
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Vector3d> corners;  ///< in order about the normal, in the plane [m]
  double area = 0;                       ///< [m^2]; 0 for collinear points
  /// Deviation of the inner angles from those of a regular polygon with as many corners, divided by
  /// its largest possible value: 0 regular .. 1 flat. 1 with fewer than three corners.
  double irregularity = 1;
};

/// points  at least one, finite; points within a micrometer of another count once
/// source  Roa & Suarez (2015), Grasp quality measures, sec. 2.2: shape and area of the grasp
///         polygon
ContactPolygon contact_polygon(const std::vector<Eigen::Vector3d>& points);

}  // namespace clench
