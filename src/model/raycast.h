// Ray casting in a world.
#pragma once
#include "clench/model/world.h"

namespace clench {

struct WorldHit {
  Id<Body> body;
  int triangle = -1;    ///< of its mesh
  double distance = 0;  ///< along the ray [m]
  Eigen::Vector3d p_W;
  Eigen::Vector3d n_W;  ///< unit, of the triangle, outward
};

/// The nearest surface along a ray, nearer than reach [m]; of equally near ones the body created
/// first.
/// direction  unit
std::optional<WorldHit> raycast(const World& world, const Eigen::Vector3d& origin,
                                const Eigen::Vector3d& direction, double reach);

}  // namespace clench
