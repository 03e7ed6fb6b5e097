// How a world moves: velocities, what motors are to do, and what a step of dynamics leaves for the
// next one.
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

/// Velocity of a rigid body, in world axes: of its centre of mass, and of its turning.
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< [m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< [rad/s]

  bool is_zero() const { return linear.isZero(0) && angular.isZero(0); }
  bool operator==(const Twist&) const = default;
};

/// Force at the centre of mass, and torque, in world axes.
struct Load {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N m]
};

/// What the motor of a DOF does. position: a spring and a damper of the DOF's gains hold it at the
/// target; velocity: the damper alone; effort: it gives what it is told.
enum class ControlMode { position, velocity, effort };

/// A smooth way from one value to another: a polynomial of the fifth degree in time, without
/// acceleration at its ends.
struct Trajectory {
  double from = 0, to = 0;         ///< [rad or m]
  double begin = 0, duration = 0;  ///< in the world's time [s]

  double value(double time) const;
  double velocity(double time) const;
};

struct DofControl {
  ControlMode mode = ControlMode::position;
  double target = 0;    ///< where a trajectory is not under way [rad or m]
  double velocity = 0;  ///< that is asked for there [rad/s or m/s]
  double effort = 0;    ///< added to what the mode gives [N m or N]
  std::optional<Trajectory> trajectory;
};

/// A point of a manifold: where two bodies touch, in their frames, so that it follows them while
/// they hardly move.
struct ManifoldPoint {
  Eigen::Vector3d p_a = {}, p_b = {};  ///< on both surfaces, each in its body's frame [m]
  Eigen::Vector3d normal = {};         ///< unit, from a into b, in the frame of a
  Feature feature_a = {}, feature_b = {};
  double gap = 0;                                    ///< when the last step ended [m]
  std::shared_ptr<const SoftPatch> patch = nullptr;  ///< of a soft contact, else null
  double torsion_radius = 0;  ///< of a soft contact, under the force torsion_force [m]
  double torsion_force = 0;   ///< [N]
  /// on b, of the last step, in the frame of a [N]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double torsion = 0;  ///< about the normal, on b [N m]
};

/// What is known of a pair of bodies between steps.
struct Manifold {
  Id<Body> a, b;  ///< the earlier one is a
  Pose X_AB;      ///< when it was last measured
  /// when the last step ended: elsewhere, somebody has moved them, and it is measured anew
  Pose X_AB_end;
  /// they were at least this far apart when it was measured [m]; 0: they overlapped
  double clearance = 0;
  std::vector<ManifoldPoint> points;  ///< none beyond the contact threshold
};

/// What steps came to.
struct StepReport {
  int64_t steps = 0;       ///< solved
  int64_t impacts = 0;     ///< steps that ended before their time, where bodies met
  int64_t iterations = 0;  ///< of the solver
  int64_t fallbacks = 0;   ///< islands of bodies that needed its slow methods
  /// islands whose residual stayed above 1e-9 m/s, or 1e-8 m/s of what rests
  int64_t failures = 0;
  int64_t overlaps = 0;     ///< pairs of bodies that stood in each other when a step began
  double residual = 0;      ///< of the last step [m/s]
  double max_residual = 0;  ///< of all
  int contacts = 0;         ///< points of the last step
};

/// Bounded forces on one coordinate, or on several in fixed ratios. The lock is that of a joint that
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
  /// DOF in the state's arrays; of a joint that has left its DOF, -1 - its index; of a joint tendon,
  /// its number among those of all robots; of free friction, 6 times the root's index + its axis
  int index = 0;
  double force = 0;  ///< [N or N m]
};

/// Of a world that has moved; flat arrays like WorldState's.
struct DynamicState {
  double time = 0;            ///< [s]
  double whole_step = 0;      ///< length of the last step, were it not for an impact [s]
  std::vector<Twist> twists;  ///< by the index of the body's id; of links too, as of the last step
  /// likewise: as the last step left them, whatever somebody has set since
  std::vector<Twist> solved;
  std::vector<double> dof_velocities;            ///< [rad/s or m/s]
  std::vector<double> joint_velocities;          ///< likewise
  std::vector<DofControl> controls;              ///< one per DOF
  std::vector<double> dof_efforts;               ///< that motors gave in the last step [N m or N]
  std::vector<Load> loads;                       ///< by index of the body, for the next step alone
  std::vector<Manifold> manifolds;               ///< of pairs that may meet soon, in creation order
  std::vector<Pose> sweep_poses;                 ///< poses when the pairs were last looked for
  double sweep_reach = 0;                        ///< how near pairs had to be then [m]
  uint64_t sweep_model = 0, sweep_settings = 0;  ///< stamps then
  double sweep_threshold = 0;                    ///< within which they touched then [m]
  std::vector<RowForce> row_forces;  ///< of what is no contact, by kind and index, for a warm start
  StepReport report;

  size_t bytes() const;
};

}  // namespace clench
