// A robot that is driven: what stays the same during a drive, and what passes from stage to stage.
#pragma once
#include <functional>

#include "clench/model/advance.h"
#include "clench/motion/blocked_joints.h"

namespace clench {

/// Values of DOFs, and positions of those joints that do not follow them.
struct DrivePosture {
  Eigen::VectorXd dofs;
  std::vector<JointPosition> own;  ///< one per joint
};

/// The robot of a drive, with everything that it carries; the same from its beginning to its end.
struct DrivenRobot {
  World& world;
  Id<Robot> id;
  CarriedBodies bodies;

  const Robot& robot() const { return world.robot(id); }
  bool sprung(int dof) const { return robot().dofs[dof].kind == DofKind::compliant; }
  void place(const DrivePosture& p) const { world.set_dofs_unchecked(id, p.dofs, p.own); }
  /// contacts of its bodies as they stand
  std::vector<Contact> touching() const;
};

/// What is known of the distances of bodies that some joint can bring together.
using PairBounds = std::vector<PairBound>;

/// Nothing is known of them yet.
PairBounds pairs_to_watch(const DrivenRobot& driven);

/// Speeds of joints that follow their DOFs.
/// pulled  also of those that contacts hold against their springs
JointSpeeds joint_speeds(const DrivenRobot& driven, const std::vector<JointPosition>& own,
                         const Eigen::VectorXd& rates, bool pulled = false);

/// Visits number and spec of all joints of a DOF.
template <class Visit>
void each_joint_of(const Robot& robot, int dof, Visit visit) {
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j)
    if (robot.joints[j].dof == dof) visit(j, robot.joints[j]);
}

/// Joints to which their DOFs have come back follow them again.
DrivePosture re_engaged(const DrivenRobot& driven, DrivePosture posture);

/// Goes along a path until its end or until a pair touches.
/// pairs    their bounds, which hold at the new place afterwards
/// speeds   of the joints along the path
/// place    place(s) sets DOFs and joints
/// queries  counts distance queries
Advance follow_path(const DrivenRobot& driven, PairBounds& pairs, const JointSpeeds& speeds,
                    double length, const std::function<void(double)>& place, int& queries);

}  // namespace clench
