// Robots as the formats of GraspIt! hold them: chains that begin on the base, joints after Denavit
// and Hartenberg, links whose frames are those after their last joints.
#pragma once
#include <functional>

#include "spec/robot_spec.h"

namespace clench {

/// The same robot, moved by the same DOFs over the same ranges. Where a link's frame has to be
/// another, its surface, centre of mass, inertia, virtual contacts, tendons and sensors are moved
/// in it. Chains and links keep their numbers. `file` is the name shown in sentences; `warn` may be
/// empty.
/// throws Error  "hand.cfg: chain 3 begins on link 'palm2' of another; ..." when that link can move
RobotSpec dh_robot(const RobotSpec& robot, const std::string& file,
                   const std::function<void(const std::string&)>& warn);

}  // namespace clench
