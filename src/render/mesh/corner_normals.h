// Vertex normals, smooth on curved surfaces and sharp at edges: one per corner of a triangle.
#pragma once
#include <array>
#include <numbers>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Unit normals, zero for triangles without area. Each corner averages those triangles around its
/// vertex whose normals are within the crease angle [rad] of its own, weighted by their angles
/// there; neighbors with opposite orientation are flipped first. Vertices shared by very many
/// triangles stay sharp.
/// source  Thuermer & Wuethrich (1998), Computing vertex normals from polygonal facets: the weights
std::vector<std::array<Eigen::Vector3f, 3>> corner_normals(
    const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& triangles,
    double crease = 35 * std::numbers::pi / 180);

}  // namespace clench
