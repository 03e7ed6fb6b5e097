// Balance of a hand's joints with contact forces: motors with their couplings, springs, clutches.
#pragma once
#include "clench/grasp/force/hand_jacobian.h"

namespace clench {

/// Source of an effort.
struct EffortRef {
  Id<Robot> robot;
  int dof = 0;
  /// the clutch of a joint that has broken away; otherwise the DOF's motor
  std::optional<JointRef> clutch = {};
};

/// A hand with springs is at rest if no joint would move farther than this [rad or m]: ten times
/// the tolerance of closing.
inline constexpr double springs_at_rest = 1e-4;

/// forces f = efforts u + springs, low <= u <= high: one row per rigid or breakaway DOF, by its
/// coupling; one per joint that has broken away; one per joint of a compliant DOF, k ratio u / sum
/// of k ratio^2 over its joints: in free air u balances all springs of stiffness k at once. If a
/// joint has none, all k count as equal.
struct JointBalance {
  Eigen::MatrixXd forces, efforts;
  Eigen::VectorXd springs;      ///< effort of springs, and of weights, in each row [N m or N]
  std::vector<EffortRef> refs;  ///< the hand's DOFs first, one each; then its arms', then clutches
  Eigen::VectorXd low, high;    ///< [N m or N], infinite: none
  /// per row: largest deviation of springs from rest, see springs_at_rest [N m or N]
  Eigen::VectorXd slack;
  /// of a compliant DOF, the effort of its tendon in its present position: the effort that balances
  /// its springs there in free air; of all others 0
  Eigen::VectorXd tendons;
};

/// Linear relation between contact forces and the efforts of motors, springs and clutches. Motors
/// exert efforts within effort_range, which may differ between the two directions. The clutch of a
/// joint that has broken away presses in its closing direction, with at most its DOF's breakaway
/// torque; a breakaway torque of 0 means no limit.
/// arms          includes the joints of robots that carry the hand
/// link_weights  springs also carry the weight of the links at each joint
JointBalance joint_balance(const World& world, const Grasp& grasp, bool arms = false,
                           bool link_weights = false);

}  // namespace clench
