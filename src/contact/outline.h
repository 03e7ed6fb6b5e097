// Outline of a flat patch of points, and a selection of its points that are far apart.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace clench {

/// Corners of the convex hull, as indices, counter-clockwise. Corners nearer than `flat` [m] to the
/// line between kept ones are omitted, so that a subdivided edge is one edge. Collinear points give
/// the two ends, coincident points give one.
///
/// source  Andrew (1979), monotone chain; Douglas & Peucker (1973)
std::vector<int> outline(const std::vector<Eigen::Vector2d>& points, double flat);

/// `first`, then repeatedly the point of `others` farthest from all chosen so far, until `most` are
/// chosen or all remaining ones lie within `radius` [m] of a chosen one. At equal distance the
/// lower index is chosen.
///
/// source  Gonzalez (1985), farthest-first traversal
std::vector<int> spread(const std::vector<Eigen::Vector2d>& points, int first,
                        const std::vector<int>& others, double radius, int most);

}  // namespace clench
