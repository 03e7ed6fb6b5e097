// Triangulation of polygons.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Maximum number of corners of a polygon that is not convex: ear clipping takes up to the cube of
/// it.
inline constexpr int max_concave_corners = 1000;

/// Triangles over the corners of a flat polygon without holes, with its orientation: a fan if it is
/// convex, otherwise by ear clipping. Self-intersecting polygons give some n - 2 triangles.
/// `convex`: assume that it is convex, as GraspIt! does.
/// `work`: counts the corners examined to find ears
/// returns  empty for fewer than 3 corners
/// throws   Error if it is not convex and has more than max_concave_corners
std::vector<Triangle> triangulate(const std::vector<Eigen::Vector3d>& corners, bool convex = false,
                                  size_t* work = nullptr);

}  // namespace clench
