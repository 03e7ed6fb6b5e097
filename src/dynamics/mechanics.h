// Momentum and energy of a world.
#pragma once
#include "clench/model/world.h"

namespace clench {

struct Momentum {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< [kg m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< about the world's origin [kg m^2/s]
};

/// Sums over all moving bodies: objects and the links of robots.
Momentum momentum(const World& world);

struct MechanicalEnergy {
  double kinetic = 0;  ///< [J]
  /// gravitational energy, 0 at the world's origin, plus that of springs [J]
  double potential = 0;
};
MechanicalEnergy mechanical_energy(const World& world);

}  // namespace clench
