// Generates the built-in meshes of MJCF: <mesh builtin="sphere" params="2"/>.
#pragma once
#include <string>
#include <vector>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

/// The mesh of a kind: sphere, hemisphere, cone, supersphere, supertorus, wedge or plate, with the
/// sizes in MuJoCo's documentation. A mesh that consists only of points represents their convex
/// hull.
/// params  as MuJoCo documents them for each kind
/// throws  Error  "cone: expected 2 parameters, got 1", beginning with the kind
/// source  MuJoCo documentation, XML reference, asset/mesh/builtin
Mesh builtin_mesh(const std::string& kind, const std::vector<double>& params);

}  // namespace clench
