// Prescribed velocities: of obstacles, of bases that a script moves, and of conveyor belts.
#pragma once
#include "clench/dynamics/tree/tree_dynamics.h"

namespace clench {

/// Velocity of the point p_W of a body [m/s]; 0 if coordinates determine it.
/// trees  of the system, at their present poses
Eigen::Vector3d prescribed_velocity(const World& world, const System& system,
                                    const std::vector<TreeDynamics>& trees, Id<Body> body,
                                    const Eigen::Vector3d& p_W);
/// Angular velocity of a body, likewise [rad/s].
Eigen::Vector3d prescribed_angular_velocity(const World& world, const System& system,
                                            Id<Body> body);
/// Velocity of a surface that runs over its body like a conveyor belt, in world axes [m/s].
Eigen::Vector3d belt_velocity(const World& world, Id<Body> body);

}  // namespace clench
