// Efforts on joints due to the links' own weight.
#pragma once
#include "clench/grasp/force/hand_jacobian.h"

namespace clench {

/// Effort of gravity on a joint through all that it moves: links, and robots that it carries [N m
/// or N].
double link_weight(const World& world, const JointRef& joint);

}  // namespace clench
