// Slides and hinges that move the base of a hand in a scene.
#pragma once
#include <string>
#include <vector>

#include "clench/io/mjcf_write/written_scene.h"

namespace clench {

/// A joint of the carriage and its servo.
struct CarriageAxis {
  std::string name;  ///< "carriage_x", ... "carriage_yaw"; name of joint and actuator
  bool turns = false;
  Eigen::Vector3d axis_B;  ///< in the base at its current pose
  double kp = 0, kd = 0;   ///< [N/m or N m/rad], [N s/m or N m s/rad]
  double hold = 0;         ///< compensates the weight at the current posture [N or N m]
};

/// Slides along the axes of the world; hinges about the axes of the base, through its origin.
struct Carriage {
  std::vector<CarriageAxis> axes;
  Pose X_WB;  ///< pose of the base when all axes are at 0

  /// Coordinates of the axes for which the base has the pose X in the world [m or rad].
  std::vector<double> coordinates(const Pose& X) const;
};

/// Hinges are added if a key turns the base. Empty if the request has no carriage.
Carriage plan_carriage(const SceneRequest& request, const WrittenScene& scene);

}  // namespace clench
