// Slides and hinges under the base of a hand, by which a scene moves it.
#pragma once
#include <string>
#include <vector>

#include "clench/io/mjcf/written_scene.h"

namespace clench {

/// A joint of the carriage and its servo.
struct CarriageAxis {
  std::string name;  ///< "carriage_x", ... "carriage_yaw"; of joint and actuator
  bool turns = false;
  Eigen::Vector3d axis_B;  ///< in the base as it stands now
  double kp = 0, kd = 0;   ///< [N/m or N m/rad], [N s/m or N m s/rad]
  double hold = 0;         ///< carries the weight as the scene stands now [N or N m]
};

/// Slides along the axes of the world; hinges about the axes of the base, through its origin.
struct Carriage {
  std::vector<CarriageAxis> axes;
  Pose X_WB;  ///< the base where all are at 0

  /// Coordinates of the axes with the base at X.
  std::vector<double> coordinates(const Pose& X) const;
};

/// Hinges are added where a key turns the base. Empty where the request has no carriage.
Carriage plan_carriage(const SceneRequest& request, const WrittenScene& scene);

}  // namespace clench
