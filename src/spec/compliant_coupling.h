// Joints that one tendon pulls against their springs: how far each goes before anything is touched.
#pragma once
#include "clench/spec/robot_spec.h"

namespace clench {

/// Makes the ratios of the joints of compliant DOFs from what files say of them. There a joint's
/// number t is the tendon's torque on the link beyond it, relative to the DOF's other joints. In
/// free air springs of stiffness k hold that: joint j feels T_j = sum of t_i (axis_i . axis_j) over
/// the DOF's joints from j outwards, and turns as T_j / k_j. So its ratio is t_1 (k_1 / k_j) (T_j /
/// T_1), 1 being the DOF's first joint, and a stiff joint closes less. A DOF keeps the file's
/// ratios when one of its joints has no spring or feels no torque its way, or when some of them
/// turn and others slide.
/// source  Dollar & Howe (2010), The highly adaptive SDM hand: joints where a tendon and springs
///         are in balance
void couple_by_springs(RobotSpec& robot);

}  // namespace clench
