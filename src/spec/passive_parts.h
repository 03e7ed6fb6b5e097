// Tendons of a hand, the posts they wrap around, tactile sensors and actuators: stored for scripts
// as described in a file, without effect on simulations. The properties of an MJCF file's actuators
// that motors use (limits, gains, which DOFs are driven) are in DofSpec.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace clench {

/// Point at which a tendon is attached to a link, or an eyelet on it.
struct TendonPoint {
  int link = -1;                                  ///< -1: the base
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();  ///< in the link's frame [m]
  double friction = 0;                            ///< Coulomb coefficient, >= 0
};

struct TendonSpec {
  std::string name;
  double stiffness = 0;                      ///< [N/m]
  std::optional<double> rest_length;         ///< [m]
  std::optional<double> pre_tension_length;  ///< [m]
  std::vector<TendonPoint> points;           ///< two or more, from one end to the other
};

/// A cylinder without ends around which tendons wrap.
struct TendonWrapper {
  int link = -1;                                      ///< -1: the base
  Eigen::Vector3d p_L = Eigen::Vector3d::Zero();      ///< on its axis, in the link's frame [m]
  Eigen::Vector3d axis_L = Eigen::Vector3d::UnitZ();  ///< unit
  double radius = 0;                                  ///< [m]
  double length = 0.01;                               ///< length for display [m]
  double friction = 0;                                ///< Coulomb coefficient, >= 0
  std::vector<std::string> exempt;                    ///< tendons that do not wrap around it
  struct Side {
    std::string tendon;
    Eigen::Vector3d direction_L;  ///< unit: towards the side on which it wraps
  };
  std::vector<Side> sides;
};

/// A box on a link; contacts in it belong to one sensor.
struct TactileSpec {
  int link = -1;  ///< -1: the base
  Eigen::Vector3d low_L = Eigen::Vector3d::Zero(),
                  high_L = Eigen::Vector3d::Zero();  ///< corners [m]
};

/// A joint that a fixed tendon pulls.
struct TendonPull {
  std::string joint;       ///< its name
  double coefficient = 1;  ///< length of the tendon per unit of the joint

  bool operator==(const TendonPull&) const = default;
};

/// force = (gain + gain_slopes[0] * length + gain_slopes[1] * velocity) * control + bias[0] + bias[1] *
/// length + bias[2] * velocity, times the gear, on its target. Length and velocity are those of the
/// target times the gear. A position servo has gain kp and bias {0, -kp, -kv}.
struct ActuatorSpec {
  std::string name;           ///< empty: it has none
  std::string kind;           ///< as its file calls it: "motor", "position", "general"
  std::string joint, tendon;  ///< target: the name of one of them; the other one is empty
  /// joints of the tendon; empty: it pulls the DOF itself, with coefficient 1
  std::vector<TendonPull> pulls = {};
  int dof = -1;            ///< DOF that it moves, for a tendon that of its first joint; -1: none
  double gear = 1;         ///< length of the actuator per unit of the target
  double length_at_0 = 0;  ///< its length with all DOFs at 0, gear included
  double gain = 1;         ///< [N m or N per unit of control]
  std::array<double, 2> gain_slopes = {0, 0};
  std::array<double, 3> bias = {0, 0, 0};
  double damping_ratio = 0;  ///< of a servo without damping in its bias: as in DofSpec
  bool law_known = true;     ///< false: gain and bias do not describe its law
  bool enabled = true;       ///< false: it exerts nothing
  std::optional<std::array<double, 2>> control_range;
  /// range of the activation that replaces the control in its law; may be infinite
  std::optional<std::array<double, 2>> activation_range;
  /// range of the force by its law, if that is unknown: a muscle only pulls [N m or N]
  std::optional<std::array<double, 2>> law_range;
  /// of the sum of the forces of all actuators on its tendon [N m or N]
  std::optional<std::array<double, 2>> tendon_force_range;
  std::optional<std::array<double, 2>> force_range;  ///< before the gear [N m or N]
};

/// All of these that a robot has.
struct PassiveParts {
  std::vector<TactileSpec> tactile;
  std::vector<TendonSpec> tendons;
  std::vector<TendonWrapper> wrappers;
  std::vector<ActuatorSpec> actuators;

  bool empty() const {
    return tactile.empty() && tendons.empty() && wrappers.empty() && actuators.empty();
  }
};

}  // namespace clench
