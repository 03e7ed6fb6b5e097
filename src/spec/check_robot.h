// Validates the description of a robot.
#pragma once
#include "clench/spec/chains.h"

namespace clench {

/// throws Error if it does not match the robot's DOFs
void check_fit(const RobotSpec& robot, const EigengraspSet& set);
void check_fit(const RobotSpec& robot, const GloveCalibration& glove);

/// throws Error with one sentence if a number is invalid: parents, DOF indices, limits, DOFs
/// without a range; or if a rule of valid.h rejects a name, number or pose
void check_robot(const RobotSpec& robot);

}  // namespace clench
