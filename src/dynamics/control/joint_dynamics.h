// Masses and forces as the DOFs of a robot feel them: for controllers that know the model.
#pragma once
#include <Eigen/Core>

#include "clench/model/world.h"

namespace clench {

/// Of a robot as it stands and moves, its base held. M dv/dt = efforts - bias - passive, where no
/// contact and no dry friction acts.
struct JointDynamics {
  /// DOFs x DOFs, with all that the links carry and the joints' armature [kg m^2, kg m or kg]
  Eigen::MatrixXd mass_matrix;
  /// of velocities, and of weight unless the motors compensate it [N m or N]
  Eigen::VectorXd bias;
  Eigen::VectorXd passive;  ///< of springs and viscous friction of the joints [N m or N]
};

/// Joints that have left their DOF count as following it. Robots that this one carries, or that
/// carry it, are held.
/// source  Featherstone (2008), Rigid Body Dynamics Algorithms, ch. 6; see tree_dynamics.h
JointDynamics joint_dynamics(const World& world, Id<Robot> robot);

}  // namespace clench
