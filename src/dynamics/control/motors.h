// Forces of motors, springs and friction on the coordinates of a tree.
#pragma once
#include "clench/dynamics/tree/tree_dynamics.h"

namespace clench {

/// Constraint on one coordinate: low <= impulse <= high keeps its velocity at a target, from which
/// it may deviate in the direction of the bound that is reached; with a compliance, velocity -
/// target + compliance * impulse is 0 between the bounds.
struct CoordinateRow {
  RowKind kind = RowKind::motor;
  int index = 0;  ///< as that of a RowForce
  int tree = 0, coordinate = 0;
  double target = 0;         ///< [rad/s or m/s]
  double low = 0, high = 0;  ///< [N m s or N s]
  double compliance = 0;
  /// coordinates and velocities per unit of each, if it acts on several; `coordinate` is one of
  /// them
  std::vector<std::pair<int, double>> arms = {};
};

/// Forces on the coordinates of a tree, and additions to its mass matrix that make springs and
/// dampers implicit (evaluated at the end of the step).
struct JointForces {
  Eigen::VectorXd efforts;  ///< of all of them [N m or N]
  Eigen::VectorXd weight;   ///< part of it that motors carry [N m or N]
  Eigen::VectorXd added;    ///< added to the diagonal of the mass matrix
  /// the part of it that acts on velocities, not on their change: damping h d and springs h^2 k
  Eigen::VectorXd velocity_part;
  /// for a floating root with resistance to free motion: additions to its part of the mass matrix,
  /// and the part of them that acts on velocities; empty: nothing
  Eigen::MatrixXd root_added, root_velocity_part;
};

/// Springs, friction, and the motor efforts that carry the robot's own weight where that is
/// compensated.
/// h  length of the step [s]
void find_joint_forces(const World& world, const Articulation& tree, const TreeDynamics& dynamics,
                       double h, const DynamicState& state, JointForces& out);

/// Motors, limits, dry friction, and locks of joints that have left their DOF.
/// mass_matrix  of the tree, armature included: default gains follow from it
void add_coordinate_rows(const World& world, const Articulation& tree, int number,
                         const Eigen::MatrixXd& mass_matrix, double h, const DynamicState& state,
                         std::vector<CoordinateRow>& out);

/// Is a limit so near that one of the next steps may reach it?
/// gap  to it, negative beyond; velocity  of the limited quantity; step  [s]
bool limit_is_near(double gap, double velocity, double step);
/// Target velocity at a limit: within it, the velocity that reaches it in one step; beyond it, a
/// gentle return.
/// beyond  excess over the limit, negative within
double limit_target(double beyond, double step);

/// Gains of a DOF's motor: those set by a script; otherwise the file's, whose damping may be a
/// ratio; otherwise those of a critically damped motor with a natural frequency of 60 rad/s.
/// inertia  effective inertia at the DOF [kg m^2 or kg]
Gains gains_of(const World& world, Id<Robot> robot, int dof, double inertia);

/// Effort of a motor in addition to that of its mode, within effort_limits, and in effort mode
/// within effort_range; 0 for a joint that has left its DOF.
double feedforward_effort(const World& world, const Coordinate& coordinate,
                          const DynamicState& state);

/// Tendons of compliant DOFs: the speed of each towards its target, as far as its effort allows.
/// Their joints follow through springs.
void pull_tendons(const World& world, Id<Robot> robot, double h, DynamicState& state);

/// Stiffness between the tendon of a compliant DOF and a joint [N m/rad or N/m].
double tendon_stiffness(const World& world, Id<Robot> robot, int joint);

}  // namespace clench
