// Joint-space dynamics of a robot, for model-based controllers.
#pragma once
#include <Eigen/Core>

#include "clench/model/world.h"

namespace clench {

/// Dynamics of a robot in its present state, with its base fixed. M dv/dt = efforts - bias -
/// passive, without contacts and dry friction.
struct JointDynamics {
  /// DOFs x DOFs, including all that the links carry and the joints' armature [kg m^2, kg m or kg]
  Eigen::MatrixXd mass_matrix;
  /// velocity-dependent efforts, and weight unless the motors compensate it [N m or N]
  Eigen::VectorXd bias;
  Eigen::VectorXd passive;  ///< of springs and viscous friction of the joints [N m or N]
};

/// Joints that have left their DOF are treated as if they followed it. Robots that carry this one
/// or are carried by it are fixed.
/// source  Featherstone (2008), Rigid Body Dynamics Algorithms, ch. 6; see tree_dynamics.h
JointDynamics joint_dynamics(const World& world, Id<Robot> robot);

}  // namespace clench
