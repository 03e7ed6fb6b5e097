// Infers from the geometry which DOFs close a hand, and in which direction, since model files do
// not specify it.
//
// The grasp's center is the mean position of the fingertips (hand_tree.h) over all values of all
// DOFs. A DOF closes if it moves its tips nearer to this center: from their initial position or, if
// that is the nearest (a gripper drawn closed), back to it. A DOF that only rolls a straight finger
// about its own axis is evaluated with the others at half their range. DOFs that move the palm do
// not close. DOFs that only swing a finger sideways, about axes that are not parallel to that of
// its last joint, do not close if they swing equally far to both sides or bring the tip hardly
// nearer, or if another finger closes beside the one that they move: they would bring it into the
// other's path.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// passive  DOFs without a motor: these do not close
/// returns  one per DOF: +1, -1, or 0: it does not close
std::vector<double> guess_closing(const RobotSpec& robot, const std::vector<bool>& passive);

}  // namespace clench
