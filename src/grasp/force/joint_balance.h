// What holds a hand's joints against contact forces: motors through their couplings, springs,
// clutches.
#pragma once
#include "clench/grasp/force/hand_jacobian.h"

namespace clench {

/// Who gives an effort.
struct EffortRef {
  Id<Robot> robot;
  int dof = 0;
  /// of a joint that has broken away, its clutch's; else the DOF's motor
  std::optional<JointRef> clutch = {};
};

/// A hand on springs has come to rest when no joint would move farther than this [rad or m]: ten
/// times what closing leaves.
inline constexpr double springs_at_rest = 1e-4;

/// forces f = efforts u + springs, low <= u <= high: one row a rigid or breakaway DOF, by its
/// coupling; one per joint that has broken away; one per joint of a compliant DOF, k ratio u / sum
/// of k ratio^2 over its joints: in free air u holds all springs of stiffness k at once. Where a
/// joint has none, all k count as alike.
struct JointBalance {
  Eigen::MatrixXd forces, efforts;
  Eigen::VectorXd springs;      ///< what springs, and weights, give in each row [N m or N]
  std::vector<EffortRef> refs;  ///< the hand's DOFs first, one each; then its arms', then clutches
  Eigen::VectorXd low, high;    ///< [N m or N], infinite: none
  /// a row: by how much springs may be off their rest, see springs_at_rest [N m or N]
  Eigen::VectorXd slack;
  /// of a compliant DOF, what its tendon gives where it stands: the effort that holds its springs
  /// there in free air; of all others 0
  Eigen::VectorXd tendons;
};

/// Linear relation between contact forces and the efforts of motors, springs and clutches. Motors
/// exert efforts within effort_range, which may differ between the two directions. The clutch of a
/// joint that has broken away presses in its closing direction, with at most its DOF's breakaway
/// torque; a breakaway torque of 0 means no limit.
/// arms          includes the joints of robots that carry the hand
/// link_weights  springs also hold what gravity gives to each joint
JointBalance joint_balance(const World& world, const Grasp& grasp, bool arms = false,
                           bool link_weights = false);

}  // namespace clench
