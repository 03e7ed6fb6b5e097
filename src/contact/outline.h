// The outline of a flat patch of points, and a few of its points that stand far apart.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

/// Corners of the convex hull, as indices, counter-clockwise. Left out are those nearer than `flat`
/// [m] to the line between kept ones, so that a subdivided edge is one edge. Points on a line: its
/// two ends. All in one: one.
///
/// source  Andrew (1979), monotone chain; Douglas & Peucker (1973)
std::vector<int> outline(const std::vector<Eigen::Vector2d>& points, double flat);

/// `first`, then of `others` always the farthest from all chosen so far, until `most` are chosen
/// or what is left lies within `radius` [m] of a chosen one. At equal distance the lower index
/// goes first.
///
/// source  Gonzalez (1985), farthest-first traversal
std::vector<int> spread(const std::vector<Eigen::Vector2d>& points, int first,
                        const std::vector<int>& others, double radius, int most);

}  // namespace clench
