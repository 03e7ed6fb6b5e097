// State of a world's motion: velocities, commands of motors, and data that a step of dynamics keeps
// for the next one.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "clench/contact/feature.h"
#include "clench/contact/materials.h"
#include "clench/contact/soft_patch.h"
#include "clench/model/body.h"

namespace clench {

/// Velocity of a rigid body, in world axes: linear, of its center of mass, and angular.
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< [m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< [rad/s]

  bool is_zero() const { return linear.isZero(0) && angular.isZero(0); }
  bool operator==(const Twist&) const = default;
};

/// Force at the center of mass, and torque, in world axes.
struct Load {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N m]
};

/// Mode of a DOF's motor. position: a spring and a damper with the DOF's gains hold the target;
/// velocity: only the damper; effort: it exerts the prescribed effort.
enum class ControlMode { position, velocity, effort };

/// A smooth trajectory from one value to another: a quintic polynomial in time, without
/// acceleration at its ends.
struct Trajectory {
  double from = 0, to = 0;         ///< [rad or m]
  double begin = 0, duration = 0;  ///< in simulation time [s]

  double value(double time) const;
  double velocity(double time) const;
};

struct DofControl {
  ControlMode mode = ControlMode::position;
  double target = 0;    ///< if no trajectory is active [rad or m]
  double velocity = 0;  ///< target velocity at the target [rad/s or m/s]
  double effort = 0;    ///< added to the effort of the mode [N m or N]
  std::optional<Trajectory> trajectory;
};

/// A contact point of a manifold, in the frames of the two bodies, so that it follows them while
/// they move only slightly.
struct ManifoldPoint {
  Eigen::Vector3d p_a = {}, p_b = {};  ///< on both surfaces, each in its body's frame [m]
  Eigen::Vector3d normal = {};         ///< unit, from a into b, in the frame of a
  Feature feature_a = {}, feature_b = {};
  double gap = 0;                                    ///< at the end of the last step [m]
  std::shared_ptr<const SoftPatch> patch = nullptr;  ///< of a soft contact, otherwise null
  double torsion_radius = 0;  ///< of a soft contact, under the force torsion_force [m]
  double torsion_force = 0;   ///< [N]
  /// on b, of the last step, in the frame of a [N]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double torsion = 0;  ///< about the normal, on b [N m]
};

/// Data of a pair of bodies kept between steps.
struct Manifold {
  Id<Body> a, b;  ///< the earlier one is a
  Pose X_AB;      ///< poses at the last measurement
  /// poses at the end of the last step: if they differ now, the pair was placed from outside, and
  /// is measured again
  Pose X_AB_end;
  /// lower bound on their distance at the measurement [m]; 0: they overlapped
  double clearance = 0;
  std::vector<ManifoldPoint> points;  ///< empty beyond the contact threshold
};

/// Statistics of steps.
struct StepReport {
  int64_t steps = 0;       ///< solved
  int64_t impacts = 0;     ///< steps that ended early because of an impact
  int64_t iterations = 0;  ///< of the solver
  int64_t fallbacks = 0;   ///< islands of bodies that needed the solver's slow methods
  /// islands whose residual stayed above 1e-9 m/s, or 1e-8 m/s for bodies at rest
  int64_t failures = 0;
  int64_t overlaps = 0;     ///< pairs of bodies that overlapped at the start of a step
  double residual = 0;      ///< of the last step [m/s]
  double max_residual = 0;  ///< of all
  int contacts = 0;         ///< points of the last step
};

/// Bounded forces on one coordinate, or on several in fixed ratios. `lock` is that of a joint that
/// has left its DOF; those from tendon_low on act on several.
enum class RowKind {
  motor,
  low_limit,
  high_limit,
  dry_friction,
  lock,
  tendon_low,
  tendon_high,
  tendon_spring,
  tendon_friction,
  free_friction
};

/// Force of a motor, limit, clutch or dry friction in the last step.
struct RowForce {
  RowKind kind = RowKind::motor;
  /// DOF in the state's arrays; for a joint that has left its DOF, -1 - its index; for a joint
  /// tendon, its index among those of all robots; for free friction, 6 times the root's index + its
  /// axis
  int index = 0;
  double force = 0;  ///< [N or N m]
};

/// Dynamic state of a world, in flat arrays like those of WorldState.
struct DynamicState {
  double time = 0;            ///< [s]
  double whole_step = 0;      ///< length of the last step, disregarding impacts [s]
  std::vector<Twist> twists;  ///< by the index of the body's id; also of links, as of the last step
  /// likewise: after the last step, unaffected by later changes
  std::vector<Twist> solved;
  std::vector<double> dof_velocities;    ///< [rad/s or m/s]
  std::vector<double> joint_velocities;  ///< likewise
  std::vector<DofControl> controls;      ///< one per DOF
  std::vector<double> dof_efforts;       ///< of motors in the last step [N m or N]
  std::vector<Load> loads;               ///< by index of the body, only for the next step
  std::vector<Manifold> manifolds;       ///< of pairs that may collide soon, in creation order
  std::vector<Pose> sweep_poses;         ///< poses at the last search for pairs
  double sweep_reach = 0;                ///< distance within which pairs were searched [m]
  uint64_t sweep_model = 0, sweep_settings = 0;  ///< stamps then
  double sweep_threshold = 0;                    ///< contact threshold of that search [m]
  /// forces other than contacts, by kind and index, for a warm start
  std::vector<RowForce> row_forces;
  StepReport report;

  size_t bytes() const;
};

}  // namespace clench
