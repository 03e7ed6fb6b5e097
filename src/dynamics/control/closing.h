// Closing a hand by its motors.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// Each DOF is sent to its limit in the sense of its default velocity, on a smooth way at that velocity times `speed`, all of
/// them faster where the longest way would take more than 3 s / speed; negative: it opens. What its motor cannot push away stops it; then it presses. DOFs without a default velocity hold.
/// throws  Error for a speed that is 0 or not finite
void close_by_motors(World& world, Id<Robot> robot, double speed);

/// Sends one DOF to a value, in a time that its largest speed is `velocity` [rad/s or m/s]; see Trajectory.
void send_dof(World& world, Id<Robot> robot, int dof, double target, double velocity);

/// Has every DOF that closes come to its limit, or does all that it moves last touch something?
bool has_closed(const World& world, Id<Robot> robot);

}  // namespace clench
