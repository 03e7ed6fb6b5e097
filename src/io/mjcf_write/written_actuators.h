// Motors of robots as MJCF actuators, with the force law of their DOFs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "clench/io/mjcf_write/written_scene.h"

namespace clench {

/// force = gain * control + bias[0] + hold + bias[1] * length + bias[2] * velocity, clamped to its
/// range.
struct WrittenActuator {
  std::string name, joint, tendon;  ///< one of joint and tendon is empty
  double gear = 1, gain = 1;
  std::array<double, 2> gain_slopes = {0, 0};
  std::array<double, 3> bias = {0, 0, 0};
  double hold = 0;  ///< compensates the weight of the moved bodies at the reference posture
  std::optional<std::array<double, 2>> control_range = {}, force_range = {};
  int robot = -1, dof = -1;  ///< -1: of the carriage
  int axis = -1;             ///< of the carriage: 0 to 5
  /// length of the actuator: coefficient per joint of its robot, times the joint's coordinate
  std::vector<std::pair<int, double>> arms = {};
  double effort_share = 0;  ///< force of the actuator per unit of extra effort of the DOF
};

/// A fixed tendon that represents a joint tendon of the robot, or belongs to an actuator.
struct WrittenTendon {
  std::string name;
  std::vector<std::pair<std::string, double>> joints;
  const JointTendonSpec* spec = nullptr;  ///< null: a passive tendon of an actuator
  double shift = 0;  ///< length with all joints of the robot at zero, in coordinates of Clench
};

struct WrittenDrives {
  std::vector<WrittenActuator> actuators;
  std::vector<WrittenTendon> tendons;
  std::vector<std::string> losses;
};

/// The actuators of a robot if its file describes them, otherwise a servo for each driven DOF.
/// Servos compensate the weight of the moved bodies at the current posture.
WrittenDrives plan_drives(const SceneRequest& request, const WrittenScene& scene);

/// Control with which the actuator holds a posture and exerts an additional effort on its DOF.
/// joints  coordinates of the joints of its robot, as in the scene
double control_for(const WrittenActuator& actuator, const std::vector<double>& joints,
                   double effort);

}  // namespace clench
