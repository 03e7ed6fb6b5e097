// A robot on its way while it is driven: its DOFs, its joints that do not follow them, the pairs
// under watch.
#pragma once
#include <functional>

#include "clench/model/advance.h"
#include "clench/motion/blocked_joints.h"

namespace clench {

/// What a drive changes from contact to contact.
struct Drive {
  World& world;
  Id<Robot> id;
  std::vector<Id<Body>> moving;
  Eigen::VectorXd q;
  std::vector<JointPosition> joint_positions;  ///< one per joint
  std::vector<PairBound> pairs;
  Eigen::VectorXd targets = {};  ///< of the DOFs, within their limits

  const Robot& robot() const { return world.robot(id); }
  bool sprung(int dof) const { return robot().dofs[dof].kind == DofKind::compliant; }
  void place() { world.set_dofs_unchecked(id, q, joint_positions); }
};

/// A robot at rest; every pair of bodies that some joint can bring together is under watch.
Drive begin_drive(World& world, Id<Robot> robot);

/// Speeds of joints that follow their DOFs.
/// pulled  also of those that contacts hold against their springs
JointSpeeds joint_speeds(const Drive& drive, const Eigen::VectorXd& rates, bool pulled = false);

/// Visits number and spec of all joints of a DOF.
template <class Visit>
void each_joint_of(const Robot& robot, int dof, Visit visit) {
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j)
    if (robot.joints[j].dof == dof) visit(j, robot.joints[j]);
}

/// Joints to which their DOFs have come back follow them again.
void re_engage(Drive& drive);

/// Goes along a path until its end or until a pair touches.
/// speeds  of the joints along it
/// place   place(s) sets DOFs and joints
Advance follow_path(Drive& drive, const JointSpeeds& speeds, double length,
                    const std::function<void(double)>& place, int& queries);

}  // namespace clench
