// Motors of robots as MJCF actuators, with the force law of their DOFs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "clench/io/mjcf_write/written_scene.h"

namespace clench {

/// force = gain * control + bias[0] + hold + bias[1] * length + bias[2] * velocity, within its
/// range.
struct WrittenActuator {
  std::string name, joint, tendon;  ///< it drives a joint or a tendon; the other is empty
  double gear = 1, gain = 1;
  std::array<double, 2> gain_slopes = {0, 0};
  std::array<double, 3> bias = {0, 0, 0};
  double hold = 0;  ///< supports the weight of what it moves at the reference posture
  std::optional<std::array<double, 2>> control_range = {}, force_range = {};
  int robot = -1, dof = -1;  ///< -1: of the carriage
  int axis = -1;             ///< of the carriage: 0 to 5
  /// length of the actuator: coefficient per joint of its robot, times the joint's coordinate
  std::vector<std::pair<int, double>> arms = {};
  double effort_share = 0;  ///< force of the actuator per unit of extra effort of the DOF
};

/// A fixed tendon, of a joint tendon of the robot or of an actuator.
struct WrittenTendon {
  std::string name;
  std::vector<std::pair<std::string, double>> joints;
  const JointTendonSpec* spec = nullptr;  ///< null: an actuator's, which is passive
  double shift = 0;  ///< length at zero of all joints of the robot, in our coordinates
};

struct WrittenDrives {
  std::vector<WrittenActuator> actuators;
  std::vector<WrittenTendon> tendons;
  std::vector<std::string> losses;
};

/// A robot's own actuators where its file describes them, else a servo for each driven DOF. Servos
/// support the weight of what they move at the present posture.
WrittenDrives plan_drives(const SceneRequest& request, const WrittenScene& scene);

/// Control at which the actuator holds a posture, pressing with an extra effort of its DOF.
/// joints  coordinates of the joints of its robot, as the scene counts them
double control_for(const WrittenActuator& actuator, const std::vector<double>& joints,
                   double effort);

}  // namespace clench
