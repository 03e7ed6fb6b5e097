#include "io/tree_model.h"

#include "base/error.h"

namespace clench {

Pose joint_pose(const TreeJoint& joint, double q) {
  const double way = q - joint.zero;
  if (joint.kind == JointKind::prismatic) return Pose::translation(way * joint.axis);
  return Pose::translation(joint.anchor) * Pose::turn(way, joint.axis) *
         Pose::translation(-joint.anchor);
}

void resolve_leaders(TreeModel& tree) {
  const int count = static_cast<int>(tree.joints.size());
  for (auto& joint : tree.joints) {
    if (joint.leader == &joint - tree.joints.data())
      fail("{}: joint '{}' follows itself", joint.place, joint.name);
    const std::string first = joint.leader < 0 ? "" : tree.joints[joint.leader].name;
    int steps = 0;
    while (joint.leader >= 0 && tree.joints[joint.leader].leader >= 0) {
      const TreeJoint& before = tree.joints[joint.leader];
      // a row of leaders that is longer than there are joints runs in a circle
      if (++steps > count)
        fail("{}: joint '{}' follows itself by way of '{}'", joint.place, joint.name, first);
      joint.offset += joint.ratio * before.offset;
      joint.ratio *= before.ratio;
      joint.leader = before.leader;
    }
  }
}

std::vector<Pose> link_poses(const TreeModel& tree, const std::vector<double>& q) {
  std::vector<Pose> poses;
  poses.reserve(tree.links.size());
  for (const TreeLink& link : tree.links) {
    Pose X = link.parent < 0 ? Pose{} : poses[link.parent] * link.X_PL;
    for (const int j : link.joints) X = X * joint_pose(tree.joints[j], q[j]);
    poses.push_back(X);
  }
  return poses;
}

}  // namespace clench
