// Formats of grasp lists.
#pragma once

namespace clench {

enum class GraspFormat { lines, csv, npz, isaac_grasp, graspgen, multigripper, graspit };

}  // namespace clench
