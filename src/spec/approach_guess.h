// Where a hand would have what it grasps, and from where: files of today do not say it, so it is
// tried out on the geometry.
//
// A ball comes to the open hand on many lines, along the direction that the hand opens to and along
// some that lean from it, until it touches; then the hand closes on it (ball_trial.h). The guess is
// the line on which the hand surrounds it best, on average with the lines beside it, so that a
// small error does no harm, and less what lies off the middle.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// What closes is told by the default velocities of the DOFs.
/// returns  approach frame in the base, its origin where the ball's centre was; where no trial held
///          the ball, or the robot has too many parts for trials, between the tips. Empty when no
///          finger closes.
std::optional<Pose> guess_approach(const RobotSpec& robot);

}  // namespace clench
