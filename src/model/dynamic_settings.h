// Settings of the dynamics of a world.
#pragma once
#include <map>
#include <optional>
#include <vector>

#include "clench/model/body.h"

namespace clench {

enum class DynamicsEngine { clench, ode };
enum class FrictionCone {
  round,   ///< |r_t| <= mu r_n
  pyramid  ///< a polygon inscribed in that circle
};

/// Gains of a DOF's motor.
struct Gains {
  double kp = 0;  ///< [N m/rad or N/m]
  double kd = 0;  ///< [N m s/rad or N s/m]

  bool operator==(const Gains&) const = default;
};

struct RobotDynamics {
  /// does its base move freely? otherwise it is fixed, or moves with its prescribed velocity
  bool floating = false;
  bool gravity_compensation = true;         ///< do its motors compensate its own weight?
  std::vector<std::optional<Gains>> gains;  ///< replace those of its file; empty: none
  /// can joints leave breakaway DOFs? otherwise these drive them rigidly, as in GraspIt!'s dynamics
  bool breakaway = false;
  /// of motors without a limit, > 0 [N m or N]; empty: none
  std::optional<double> max_effort = {};

  bool operator==(const RobotDynamics&) const = default;
};

struct DynamicSettings {
  double step = 1e-3;  ///< > 0 [s]
  DynamicsEngine engine = DynamicsEngine::clench;
  FrictionCone cone = FrictionCone::round;
  int cone_edges = 8;                         ///< of a pyramid
  std::map<Id<Robot>, RobotDynamics> robots;  ///< others have the default RobotDynamics
  /// of conveyor belts, in their bodies' frames [m/s]
  std::map<Id<Body>, Eigen::Vector3d> surface_velocities;
  /// objects, and the body to which each is welded; no cycles
  std::map<Id<Body>, Id<Body>> welds;

  bool operator==(const DynamicSettings&) const = default;
  const RobotDynamics& robot(Id<Robot> id) const {
    static const RobotDynamics plain;
    const auto found = robots.find(id);
    return found == robots.end() ? plain : found->second;
  }
};

}  // namespace clench
