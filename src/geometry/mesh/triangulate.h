// Polygons to triangles.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Most corners of a polygon that is not convex: cutting off ears costs up to the cube of them.
inline constexpr int max_concave_corners = 1000;

/// Triangles over the corners of a flat polygon without holes, turning the way it turns: a fan when
/// it is convex, ears cut off one by one when it is not. Crooked ones give n - 2 triangles of some
/// kind.
/// `convex`: take the file's word for it, as the original does.
/// `work`: counts the corners that are looked at to find ears
/// returns  none for fewer than 3 corners
/// throws   Error when it is not convex and has more than max_concave_corners
std::vector<Triangle> triangulate(const std::vector<Eigen::Vector3d>& corners, bool convex = false,
                                  size_t* work = nullptr);

}  // namespace clench
