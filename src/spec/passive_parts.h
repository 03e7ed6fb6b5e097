// Tendons of a hand, the posts they wrap around, tactile sensors and actuators: kept for scripts as
// a file describes them; nothing acts on them. What motors take from an MJCF file's actuators
// (limits, gains, which DOFs are driven) is in DofSpec.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace clench {

/// Where a tendon is tied to a link, or runs through an eyelet on it.
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
  double length = 0.01;                               ///< of its picture [m]
  double friction = 0;                                ///< Coulomb coefficient, >= 0
  std::vector<std::string> exempt;                    ///< tendons that pass it by
  struct Side {
    std::string tendon;
    Eigen::Vector3d direction_L;  ///< unit: towards the side on which it wraps
  };
  std::vector<Side> sides;
};

/// A box on a link in which contacts count as one sensor's.
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
  std::string joint, tendon;  ///< what it drives: the name of one of them; the other one is empty
  /// joints of the tendon; none: it pulls the DOF itself, with coefficient 1
  std::vector<TendonPull> pulls = {};
  int dof = -1;            ///< that it moves, of a tendon that of its first joint; -1: none
  double gear = 1;         ///< length of the actuator per unit of the target
  double length_at_0 = 0;  ///< its length where all DOFs are 0, gear included
  double gain = 1;         ///< [N m or N per unit of control]
  std::array<double, 2> gain_slopes = {0, 0};
  std::array<double, 3> bias = {0, 0, 0};
  double damping_ratio = 0;  ///< of a servo, whose bias has no damping then: as DofSpec
  bool law_known = true;     ///< false: gain and bias do not describe it
  bool enabled = true;       ///< false: it exerts nothing
  std::optional<std::array<double, 2>> control_range;
  /// of the activation that its law takes in place of the control, an end perhaps infinite
  std::optional<std::array<double, 2>> activation_range;
  /// of the force by its law, where that is not known: a muscle only pulls [N m or N]
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
