// Velocities that no coordinate changes: of obstacles, of bases that a script moves, and of belts.
#pragma once
#include "clench/dynamics/tree/tree_dynamics.h"

namespace clench {

/// Of the point p_W of a body [m/s]; 0 where coordinates give the velocity.
/// trees  of the system, where they stand
Eigen::Vector3d prescribed_velocity(const World& world, const System& system,
                                    const std::vector<TreeDynamics>& trees, Id<Body> body,
                                    const Eigen::Vector3d& p_W);
/// Likewise the angular velocity [rad/s].
Eigen::Vector3d prescribed_angular_velocity(const World& world, const System& system,
                                            Id<Body> body);
/// Of a surface that runs over its body like a conveyor belt, in world axes [m/s].
Eigen::Vector3d belt_velocity(const World& world, Id<Body> body);

}  // namespace clench
