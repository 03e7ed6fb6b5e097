#include "clench/io/mjcf/joints/mjcf_ties.h"

namespace clench {

int leader_of(const TreeModel& tree, int joint) { return by_leader(tree, joint).leader; }

TiedJoint by_leader(const TreeModel& tree, int joint) {
  TiedJoint out{joint};
  for (size_t i = 0; i <= tree.joints.size(); ++i) {
    const TreeJoint& at = tree.joints[out.leader];
    if (at.leader < 0) return out;
    out = {at.leader, out.ratio * at.ratio, out.offset + out.ratio * at.offset};
  }
  return {};
}

void tie_joint(TreeModel& tree, int follower, int leader, double ratio, double offset,
               const XmlElement& at, const FileCache& cache) {
  TreeJoint& joint = tree.joints[follower];
  if (joint.leader >= 0 || leader_of(tree, leader) == follower) {
    cache.diagnostics().warn(at.place(), "joint '{}' is tied already; this does not tie it to '{}'",
                             excerpt(joint.name), excerpt(tree.joints[leader].name));
    return;
  }
  joint.leader = leader;
  joint.ratio = ratio;
  joint.offset = offset;
}

}  // namespace clench
