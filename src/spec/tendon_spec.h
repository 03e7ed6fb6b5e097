// Tendons of a hand, the posts they wrap around, and tactile sensors: kept as a file describes
// them; nothing acts on them.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "clench/spec/actuator_spec.h"

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
