// Recognizes meshes that are tessellations of round solids.
#pragma once
#include <optional>

#include "clench/geometry/mesh/mesh.h"
#include "clench/geometry/round/round.h"

namespace clench {

/// The ball, capsule or cylinder of which a closed mesh is a tessellation: all its vertices lie on
/// the solid's surface, to a millionth of its size, and it fills at least 95 % of it, as prisms of
/// 12 sides and more do. A cap or a bowl does not, nor does a cube.
std::optional<RoundPiece> round_of(const Mesh& mesh);

/// Do all vertices of the piece's triangles lie on its surface, to a millionth of its size?
bool lies_on(const Mesh& mesh, const RoundPiece& piece);

/// The solids of connected parts of a mesh, as found by round_of(). Parts whose triangles are not
/// consecutive are omitted.
std::vector<RoundPiece> round_parts(const Mesh& mesh);

}  // namespace clench
