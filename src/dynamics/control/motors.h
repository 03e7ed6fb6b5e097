// What motors, springs and friction do to the coordinates of a tree.
#pragma once
#include "clench/dynamics/tree/tree_dynamics.h"

namespace clench {

/// Of one coordinate: low <= impulse <= high holds its velocity at a target, which it may leave in
/// the sense of the bound that is reached; with a compliance, velocity - target + compliance *
/// impulse is 0 between them.
struct CoordinateRow {
  RowKind kind = RowKind::motor;
  int index = 0;  ///< as that of a RowForce
  int tree = 0, coordinate = 0;
  double target = 0;         ///< [rad/s or m/s]
  double low = 0, high = 0;  ///< [N m s or N s]
  double compliance = 0;
  /// coordinates and velocities per unit of each, where it acts on several; `coordinate` is one
  std::vector<std::pair<int, double>> arms = {};
};

/// Forces on the coordinates of a tree, and what is added to its mass matrix so that springs and
/// dampers act as they are when the step ends.
struct JointForces {
  Eigen::VectorXd efforts;  ///< of all of them [N m or N]
  Eigen::VectorXd weight;   ///< that motors carry, of that [N m or N]
  Eigen::VectorXd added;    ///< to the diagonal of the mass matrix
  /// the part of it that acts on velocities, not on their change: damping h d and springs h^2 k
  Eigen::VectorXd velocity_part;
  /// of a root that floats and resists free motion: what is added to its part of the mass matrix,
  /// and the part of that which acts on velocities; empty: nothing
  Eigen::MatrixXd root_added, root_velocity_part;
};

/// Springs, friction, and what motors give to carry the robot's own weight where they are to.
/// h  length of the step [s]
void find_joint_forces(const World& world, const Articulation& tree, const TreeDynamics& dynamics,
                       double h, const DynamicState& state, JointForces& out);

/// Motors, limits, dry friction, and locks of joints that have left their DOF.
/// mass_matrix  of the tree, armature included: gains that no file gives follow from it
void add_coordinate_rows(const World& world, const Articulation& tree, int number,
                         const Eigen::MatrixXd& mass_matrix, double h, const DynamicState& state,
                         std::vector<CoordinateRow>& out);

/// Is a limit so near that the next steps may reach it?
/// gap  to it, negative beyond; velocity  of what it limits; step  [s]
bool limit_is_near(double gap, double velocity, double step);
/// Velocity that a limit asks for: within it, what reaches it in a step; beyond it, a gentle
/// return.   beyond  how far it is exceeded, negative within
double limit_target(double beyond, double step);

/// Gains of a DOF's motor: those set for it; else its file's, whose damping may be a ratio; else
/// those of a motor of critical damping that swings back at 60 rad/s.   inertia  that the DOF feels
/// [kg m^2 or kg]
Gains gains_of(const World& world, Id<Robot> robot, int dof, double inertia);

/// Effort of a motor beside that of its mode, within effort_limits, and in effort mode within
/// effort_range; 0 for a joint that has left its DOF.
double feedforward_effort(const World& world, const Coordinate& coordinate,
                          const DynamicState& state);

/// Tendons of compliant DOFs: how fast each goes to its target, as far as its effort allows. Their
/// joints follow by springs.
void pull_tendons(const World& world, Id<Robot> robot, double h, DynamicState& state);

/// Stiffness between the tendon of a compliant DOF and a joint [N m/rad or N/m].
double tendon_stiffness(const World& world, Id<Robot> robot, int joint);

}  // namespace clench
