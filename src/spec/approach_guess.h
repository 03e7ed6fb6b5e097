// Infers the approach frame of a hand, which model files do not specify, by trials on its geometry.
//
// A ball approaches the open hand on many lines, along the direction in which the hand opens and
// some that lean from it, until it touches; then the hand closes on it (ball_trial.h). The result
// is the line on which the hand surrounds the ball best, averaged with adjacent lines, so that a
// small error does no harm, with a penalty for lines away from the middle.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// The default velocities of the DOFs determine which of them close.
/// returns  approach frame in the base, its origin at the ball's center; if no trial held the ball,
///          or the robot has too many parts for trials, between the tips. Empty if no finger
///          closes.
std::optional<Pose> guess_approach(const RobotSpec& robot);

}  // namespace clench
