// Meshes that stand for balls.
#pragma once
#include <optional>

#include "clench/geometry/mesh/mesh.h"

namespace clench {

struct Sphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
  double radius = 0;                                 ///< [m]
};

/// The ball that a closed mesh is a tessellation of: all its vertices lie on one sphere, to a
/// millionth of its radius, and it fills at least 95 % of it. A cap or a bowl does not, nor does a
/// cube.
/// volume  that it encloses [m^3]
std::optional<Sphere> ball_of(const Mesh& mesh, double volume);

}  // namespace clench
