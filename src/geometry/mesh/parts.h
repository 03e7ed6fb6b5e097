// Connected parts of a mesh.
#pragma once
#include "clench/base/disjoint_sets.h"
#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// Sets of vertices: those of a triangle belong to one, and so do those at the same position, so
/// that files without shared vertices are connected.
DisjointSets connected_vertices(const Mesh& mesh);

}  // namespace clench
