// Smooth where a surface is round, sharp where it has an edge: one normal for each corner of a
// triangle.
#pragma once
#include <array>
#include <numbers>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Unit normals, zero for triangles without area. Each corner averages the triangles around its
/// vertex that lean less than the crease angle [rad] from its own, weighted by their angles there;
/// neighbors that run the other way round are turned over first. Vertices shared by very many
/// triangles stay sharp.
/// source  Thuermer & Wuethrich (1998), Computing vertex normals from polygonal facets: the weights
std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(
    const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& triangles,
    double crease = 35 * std::numbers::pi / 180);

}  // namespace clench
