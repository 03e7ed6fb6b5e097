// The numbers of a robot as its files in the formats of GraspIt! write them: millimetres, grams,
// degrees, by the kinds of the joints.
#pragma once
#include <string>

#include "spec/robot_spec.h"

namespace clench {

/// Each reads back to the bit, where its unit has such a number.
struct DofTexts {
  std::string kind;  ///< r, b or c
  std::string velocity, effort, kp, kd, scale, breakaway, value;
};

struct JointTexts {
  std::string theta, d;  ///< one is an expression: d0*0.5+90
  std::string a, alpha, min, max, viscous, coulomb, spring, rest;
};

DofTexts dof_texts(const RobotSpec& robot, int dof);
JointTexts joint_texts(const RobotSpec& robot, const JointSpec& joint);
/// "x y z", in the unit of v.
std::string words(const Eigen::Vector3d& v);

}  // namespace clench
