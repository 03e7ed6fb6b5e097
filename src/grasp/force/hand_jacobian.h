// Hand Jacobian: velocities of the contacts per joint, and efforts of the motors for given contact
// forces.
#pragma once
#include "clench/grasp/wrench/grasp.h"
#include "clench/grasp/wrench/grasp_map.h"

namespace clench {

/// A joint of the hand, or of a robot that carries it.
struct JointRef {
  Id<Robot> robot;
  int joint = 0;  ///< index in the robot
};

struct HandJacobian {
  /// forces x joints: velocity of the hand's side of each contact along the force directions of the
  /// grasp map's columns, per unit velocity of the joint [m, 1, rad and rad/m per unit of joint].
  /// Its transpose times forces is the effort that each joint must exert.
  Eigen::MatrixXd of_joints;
  /// those of the hand first; then, if requested, of the robots that carry it
  std::vector<JointRef> joints;
};

struct JacobianOptions {
  bool arms = false;  ///< include the joints of the robots that carry the hand
};

/// throws  Error as check_unmoved does
/// source  Murray, Li & Sastry (1994), ch. 5: hand Jacobian
HandJacobian hand_jacobian(const World& world, const Grasp& grasp,
                           const JacobianOptions& options = {});

/// Columns of the hand's DOFs: the combined motion of their joints that have not broken away, by
/// their ratios.
///
/// returns  forces x DOFs
Eigen::MatrixXd dof_jacobian(const World& world, const Grasp& grasp, const HandJacobian& jacobian);

}  // namespace clench
