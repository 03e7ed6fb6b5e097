// Meshes that scripts give as tables.
#pragma once
#include "clench/geometry/tree/shape.h"
#include "clench/io/text/read_options.h"
#include "clench/script/lua/table.h"

namespace clench {

struct MeshTable {
  Mesh mesh;
  RoundPieces rounds;

  /// Scales all lengths.   factor  > 0
  void scale(double factor);
};

/// Reads {vertices =, triangles =, round =}, the format of shapes of the standard library. round:
/// true searches the connected parts for round solids; a list names the solids.
MeshTable read_mesh_table(lua_State* L, int i, const ReadOptions& reading);

}  // namespace clench
