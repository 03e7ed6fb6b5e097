// Exact tests between two triangles, a point and a triangle, two segments. Includes degenerate
// triangles: one without area is the segment or point that it covers.
#pragma once
#include <Eigen/Core>
#include <array>

namespace clench {

using Corners = std::array<Eigen::Vector3d, 3>;

struct Closest {
  double distance = 0;   ///< [m]
  Eigen::Vector3d p, q;  ///< nearest point on the first, on the second
};

/// source  Ericson (2005), ch. 5.1.9
Closest segment_segment(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                        const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);

/// p is the point itself, q lies on the triangle.
/// source  Ericson (2005), ch. 5.1.5
Closest point_triangle(const Eigen::Vector3d& p, const Corners& triangle);

/// Do they share a point? Touching counts: disjoint means that some direction shows a gap beyond
/// rounding, about 1e-14 of the extent of the two.
bool triangles_meet(const Corners& a, const Corners& b);

/// Distance and witness points; 0 and a common point if they intersect, and only then.
Closest triangle_triangle(const Corners& a, const Corners& b);

/// triangle_triangle of `count` pairs, several times as fast; same bits
void triangle_pairs(const Corners* a, const Corners* b, int count, Closest* out);

}  // namespace clench
