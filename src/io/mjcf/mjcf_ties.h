// Joints of an MJCF tree that follow other joints.
#pragma once
#include "clench/io/text/file_cache.h"
#include "clench/io/text/xml.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

/// The joint that a row of leaders ends at; -1: the row is a circle.
int leader_of(const TreeModel& tree, int joint);

/// q = ratio * leader + offset, unless the joint follows another one, which is warned of.
void tie_joint(TreeModel& tree, int follower, int leader, double ratio, double offset,
               const XmlElement& at, const FileCache& cache);

/// A joint by the joint at the end of its row of leaders: q = ratio * leader + offset.
struct TiedJoint {
  int leader = -1;  ///< -1: its row is a circle
  double ratio = 1, offset = 0;
};
TiedJoint by_leader(const TreeModel& tree, int joint);

}  // namespace clench
