// Closing a hand by its motors.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Each DOF is sent to its limit in the sense of its default velocity, on a smooth way at that
/// velocity times `speed`, all of them faster where one would go for more than 3 s at speed 1 and
/// constant velocity; negative: it opens. What its motor cannot push away stops it; then it
/// presses. DOFs without a default velocity hold; those that no motor drives stay free.
/// throws  Error for a speed that is 0 or not finite, and where no DOF that closes has a motor
void close_by_motors(World& world, Id<Robot> robot, double speed);

/// Sends one DOF to a value, in a time that its largest speed is `velocity` [rad/s or m/s]; see
/// Trajectory.
void send_dof(World& world, Id<Robot> robot, int dof, double target, double velocity);

/// Of every chain: does its last link touch something, is its last joint's DOF within 0.03 of the
/// limit that it closes to, or has it come to rest after the time in which it was to close?
bool has_closed(const World& world, Id<Robot> robot);

}  // namespace clench
