// State of a driven robot: data that are constant during a drive, and data passed between its
// stages.
#pragma once
#include <functional>

#include "clench/model/advance.h"
#include "clench/motion/blocked_joints.h"

namespace clench {

/// Values of DOFs, and positions of those joints that do not follow them.
struct DrivePosture {
  Eigen::VectorXd dofs;
  std::vector<JointPosition> own;  ///< one per joint; empty: it follows its DOF
};

/// The robot of a drive, with everything that it carries; constant during the drive.
struct DrivenRobot {
  World& world;
  Id<Robot> id;
  CarriedBodies bodies;

  const Robot& robot() const { return world.robot(id); }
  bool sprung(int dof) const { return robot().dofs[dof].kind == DofKind::compliant; }
  void place(const DrivePosture& p) const { world.set_dofs_unchecked(id, p.dofs, p.own); }
  /// present contacts of its bodies
  std::vector<Contact> touching() const;
};

/// Distance bounds of pairs of bodies that some joint can bring together.
using PairBounds = std::vector<PairBound>;

/// The pairs, with unknown distances.
PairBounds pairs_to_watch(const DrivenRobot& driven);

/// Speeds of joints that follow their DOFs.
/// pulled  also of those that contacts hold against their springs
JointSpeeds joint_speeds(const DrivenRobot& driven, const std::vector<JointPosition>& own,
                         const Eigen::VectorXd& rates, bool pulled = false);

/// Visits index and spec of all joints of a DOF.
template <class Visit>
void each_joint_of(const Robot& robot, int dof, Visit visit) {
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j)
    if (robot.joints[j].dof == dof) visit(j, robot.joints[j]);
}

/// Joints to whose positions their DOFs have returned follow them again.
DrivePosture re_engaged(const DrivenRobot& driven, DrivePosture posture);

/// Follows a path until its end or until a pair touches.
/// pairs    their bounds, updated to hold at the end
/// speeds   of the joints along the path
/// place    place(s) sets DOFs and joints
/// queries  counts distance queries
Advance follow_path(const DrivenRobot& driven, PairBounds& pairs, const JointSpeeds& speeds,
                    double length, const std::function<void(double)>& place, int& queries);

}  // namespace clench
