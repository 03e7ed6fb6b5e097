// Which DOFs close a hand, and which way: files of today do not say it, so it is guessed from the
// geometry.
//
// The grasp's centre is where the fingertips (hand_tree.h) are on average, over all values of all
// DOFs. A DOF closes if it brings the tips that it moves nearer to this centre: from where they
// stand at first, or, when they stand nearest there (a gripper drawn shut), back to there. A DOF
// that only rolls a straight finger about itself is judged with the others at half their way. DOFs
// that move the palm stay. DOFs that only swing a finger sideways, about axes that do not lie along
// that of its last joint, stay when they swing as far to either side or bring the tip hardly
// nearer, or when another finger closes beside the one that they move: they would bring it into the
// other's way.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// passive  DOFs that no motor drives: these stay
/// returns  one per DOF: +1, -1, or 0: it stays
std::vector<double> guess_closing(const RobotSpec& robot, const std::vector<bool>& passive);

}  // namespace clench
