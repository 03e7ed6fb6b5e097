// Is a robot's description in order?
#pragma once
#include "clench/spec/chains.h"

namespace clench {

/// throws Error when it does not fit the robot's DOFs
void check_fit(const RobotSpec& robot, const EigengraspSet& set);
void check_fit(const RobotSpec& robot, const GloveCalibration& glove);

/// throws Error with one sentence when a number is out of order: parents, DOF indices, limits, DOFs
/// without a range; or when a rule of valid.h refuses a name, number or pose
void check_robot(const RobotSpec& robot);

}  // namespace clench
