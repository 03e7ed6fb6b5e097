// Applies the actuators of an MJCF file to a robot: driven DOFs, gains, maximum efforts, and joints
// that are coupled by an actuated tendon.
#pragma once
#include <vector>

#include "clench/io/mjcf/joints/mjcf_actuator.h"
#include "clench/io/mjcf/joints/mjcf_tendons.h"

namespace clench {

/// An actuator and its target: a joint of the tree, or a fixed tendon with joints.
struct MjcfDrive {
  MjcfActuator actuator;
  int joint = -1;                      ///< -1: the tendon is the target
  const MjcfTendon* tendon = nullptr;  ///< null: the joint is the target
};

/// Sets ranges and gains of the DOFs, couples joints that share a tendon, and adds tree.actuators;
/// `driven` marks DOFs with an actuator, see settle_motors. Joints that share a tendon move in
/// proportion to their coefficients, unless another actuator pulls them in another ratio: then they
/// stay independent.
void apply_mjcf_drives(const std::vector<MjcfDrive>& drives, MjcfDocument& document,
                       const FileCache& cache, TreeModel& tree);

}  // namespace clench
