// Virtual contacts: points on a hand's links at which it is intended to touch an object.
#pragma once
#include <Eigen/Core>
#include <string>

#include "clench/math/pose.h"

namespace clench {

/// Columns are generators of the friction of a unit normal force, in the contact frame: force / mu,
/// and torque / mu [m]. Only x, y and the torque about z are used by contacts of fingers.
using FrictionEdges = Eigen::Matrix<double, 6, Eigen::Dynamic>;

inline constexpr int max_friction_edges = 100;

struct VirtualContactSpec {
  int link = -1;        ///< of the robot; -1: the base
  Pose X_LC;            ///< contact frame in the link: +z out of the link, into the object
  double mu = 1;        ///< Coulomb coefficient, >= 0
  FrictionEdges edges;  ///< 6 x edges; may have no columns
};

/// throws Error with one sentence that begins with the subject if a rule rejects a number or the
/// frame, or there are more than max_friction_edges
void check_virtual_contact(const VirtualContactSpec& contact, const std::string& subject);

}  // namespace clench
