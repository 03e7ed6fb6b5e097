// Meshes that MJCF files name instead of giving them: <mesh builtin="sphere" params="2"/>.
#pragma once
#include <string>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// The mesh of a kind: sphere, hemisphere, cone, supersphere, supertorus, wedge or plate, in the
/// sizes of MuJoCo's documentation. A mesh of points alone, without triangles, means their hull.
/// params  as MuJoCo documents them for each kind
/// throws  Error  "cone: expected 2 parameters, got 1"  with the kind in front
/// source  MuJoCo documentation, XML reference, asset/mesh/builtin
Mesh builtin_mesh(const std::string& kind, const std::vector<double>& params);

}  // namespace clench
