// Actuators that move several DOFs, such as those on a tendon of a differential drive.
#pragma once
#include <map>
#include <vector>

#include "clench/model/world.h"

namespace clench {

/// An actuator that exerts one force on several DOFs.
struct SharedActuator {
  EffortRange force;  ///< limits at rest, in the robot's present posture [N m or N]
  std::vector<std::pair<int, double>> reaches;  ///< DOFs, and the effort of each per unit of force
};

struct SharedActuators {
  std::vector<SharedActuator> actuators;
  /// for each of their DOFs: efforts of its other actuators [N m or N]
  std::map<int, EffortRange> others;
};

/// The actuators of the robot that move several driven DOFs.
SharedActuators shared_actuators(const World& world, Id<Robot> robot);

}  // namespace clench
