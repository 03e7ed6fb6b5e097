// What the links' own weight asks of joints.
#pragma once
#include "clench/grasp/force/hand_jacobian.h"

namespace clench {

/// Torque or force that gravity gives to a joint through all that it moves: links, and robots that
/// it carries [N m or N].
double link_weight(const World& world, const JointRef& joint);

}  // namespace clench
