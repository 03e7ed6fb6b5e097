// Meshes that scripts give as tables.
#pragma once
#include "clench/geometry/tree/shape.h"
#include "clench/io/text/read_options.h"
#include "clench/script/lua/table.h"

namespace clench {

struct MeshTable {
  Mesh mesh;
  RoundPieces rounds;

  /// factor  > 0
  void scale(double factor);
};

/// {vertices =, triangles =, round =}, as the shapes of the standard library are: `round` is true
/// where parts may stand for round solids, which are then looked for, or a list of them.
MeshTable read_mesh_table(lua_State* L, int i, const ReadOptions& reading);

}  // namespace clench
