// Springs and dampers of joints given in MJCF by a time constant and a damping ratio.
#pragma once
#include <Eigen/Core>

#include "clench/io/tree/tree_model.h"

namespace clench {

/// Sets for each joint with `spring_damper` stiffness I / (t z)^2 and damping 2 I / t, for the time
/// constant t, the damping ratio z and the inertia I = 1 / (M^-1)_jj, where M is the mass matrix at
/// the reference. The three hinges of a ball joint use the mean of 1 / I. The masses of the links
/// must be set.
/// floating  true if the first link moves freely
/// source    MuJoCo 3: XML reference, "joint: springdamper"
void set_springs_and_dampers(TreeModel& tree, bool floating);

/// Mass matrix with all joints at their references, including armature [kg m^2, kg m or kg]: one
/// row per joint, then six for a first link that moves freely.
Eigen::MatrixXd reference_mass_matrix(const TreeModel& tree, bool floating);

}  // namespace clench
