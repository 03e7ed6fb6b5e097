// What moves in a world: momentum and energy.
#pragma once
#include "clench/model/world.h"

namespace clench {

struct Momentum {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< [kg m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< about the world's origin [kg m^2/s]
};

/// Of everything that moves of its own: objects and the parts of robots.
Momentum momentum(const World& world);

struct MechanicalEnergy {
  double kinetic = 0;    ///< [J]
  double potential = 0;  ///< of gravity, 0 at the world's origin, and of springs [J]
};
MechanicalEnergy mechanical_energy(const World& world);

}  // namespace clench
