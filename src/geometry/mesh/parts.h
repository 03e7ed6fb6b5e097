// Parts of a mesh that hang together.
#pragma once
#include "clench/base/disjoint_sets.h"
#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Sets of vertices: those of a triangle are in one, and those at one place, for files without
/// shared vertices are connected by position.
DisjointSets connected_vertices(const Mesh& mesh);

}  // namespace clench
