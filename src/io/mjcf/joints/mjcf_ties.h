// Joints of an MJCF tree that follow other joints, their leaders.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/text/xml.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

/// The joint at the end of a chain of leaders; -1: the chain is a cycle.
int leader_of(const TreeModel& tree, int joint);

/// Sets q = ratio * leader + offset; if the joint already follows another one, warns instead.
void tie_joint(TreeModel& tree, int follower, int leader, double ratio, double offset,
               const XmlElement& at, const FileCache& cache);

/// A joint expressed by the joint at the end of its chain of leaders: q = ratio * leader + offset.
struct TiedJoint {
  int leader = -1;  ///< -1: the chain is a cycle
  double ratio = 1, offset = 0;
};
TiedJoint by_leader(const TreeModel& tree, int joint);

}  // namespace clench
