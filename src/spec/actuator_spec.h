// Actuators as an MJCF file describes them. What motors take from them (limits, gains, which DOFs
// are driven) is in DofSpec; their laws are kept for scripts.
#pragma once
#include <array>
#include <optional>
#include <string>

namespace clench {

/// force = gain * control + bias[0] + bias[1] * length + bias[2] * velocity, times the gear, on its
/// target. Length and velocity are those of the target times the gear. A position servo has gain kp
/// and bias {0, -kp, -kv}.
struct ActuatorSpec {
  std::string name;           ///< empty: it has none
  std::string kind;           ///< as its file calls it: "motor", "position", "general"
  std::string joint, tendon;  ///< what it drives: the name of one of them; the other one is empty
  int dof = -1;               ///< that it moves; -1: none of the robot
  double gear = 1;            ///< length of the actuator per unit of the target
  double gain = 1;            ///< [N m or N per unit of control]
  std::array<double, 3> bias = {0, 0, 0};
  double damping_ratio = 0;  ///< of a servo, whose bias has no damping then: as DofSpec
  bool law_known = true;     ///< false: gain and bias do not describe it
  std::optional<std::array<double, 2>> control_range;
  std::optional<std::array<double, 2>> force_range;  ///< before the gear [N m or N]
};

}  // namespace clench
