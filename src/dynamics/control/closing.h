// Closing a hand by its motors.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Each DOF moves to its limit in the direction of its default velocity, on a smooth trajectory at
/// that velocity times `speed`; if one would take more than 3 s at speed 1 and constant velocity,
/// all are sped up by the same factor. Negative speed opens the hand. A DOF stops at what its motor
/// cannot push away, and then presses on it. DOFs without a default velocity hold their position;
/// those without a motor stay free.
/// throws  Error for a speed that is 0 or not finite, and if no DOF that closes has a motor
void close_by_motors(World& world, Id<Robot> robot, double speed);

/// Moves one DOF to a value, in a time such that its largest speed is `velocity` [rad/s or m/s];
/// see Trajectory.
void send_dof(World& world, Id<Robot> robot, int dof, double target, double velocity);

/// For every chain: does its last link touch something, is its last joint's DOF within 0.03 of its
/// closing limit, or is it at rest after the expected closing time?
bool has_closed(const World& world, Id<Robot> robot);

}  // namespace clench
