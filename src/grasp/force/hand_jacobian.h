// How a hand's joints move its contacts, and what its motors must give for contact forces.
#pragma once
#include "clench/grasp/wrench/grasp.h"
#include "clench/grasp/wrench/grasp_map.h"

namespace clench {

/// A joint of the hand, or of a robot that carries it.
struct JointRef {
  Id<Robot> robot;
  int joint = 0;  ///< number in the robot
};

struct HandJacobian {
  /// forces x joints: velocity of the hand's side of each contact along what the grasp map's
  /// columns press with, the joint at 1 [m, 1, rad and rad/m per unit of joint]. Its transpose
  /// times forces is the torque or force that each joint must give.
  Eigen::MatrixXd of_joints;
  /// those of the hand first; then, when asked for, of who carries it
  std::vector<JointRef> joints;
};

struct JacobianOptions {
  bool arms = false;  ///< the joints of the robots that carry the hand, too
};

/// throws  Error as check_unmoved does
/// source  Murray, Li & Sastry (1994), ch. 5: hand Jacobian
HandJacobian hand_jacobian(const World& world, const Grasp& grasp,
                           const JacobianOptions& options = {});

/// Columns of the hand's DOFs: what its joints that have not broken away do together, by their
/// ratios.
///
/// returns  forces x DOFs
Eigen::MatrixXd dof_jacobian(const World& world, const Grasp& grasp, const HandJacobian& jacobian);

}  // namespace clench
