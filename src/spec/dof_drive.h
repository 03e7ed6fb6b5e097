// Range of the effort that the drive of a DOF can exert, from the laws and limits of its actuators.
#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "clench/spec/robot_spec.h"

namespace clench {

/// Efforts from low to high; infinite without a limit [N m or N].
struct EffortRange {
  double low = 0, high = 0;

  bool is_zero() const { return low == 0 && high == 0; }
  bool operator==(const EffortRange&) const = default;
};

/// Effect of an actuator on one DOF: effort = reach * force, force = clamp((gain[0] + gain[1] *
/// length + gain[2] * velocity) * control + bias[0] + bias[1] * length + bias[2] * velocity), with
/// the control within its range, and length = offset + sum of arms * DOFs.
struct DriveTerm {
  static constexpr double none = std::numeric_limits<double>::infinity();

  double reach = 1;                               ///< effort per unit of force
  std::vector<std::pair<int, double>> arms = {};  ///< DOFs, and length per unit of each
  double offset = 0;                              ///< length with all DOFs at 0
  std::array<double, 3> gain = {1, 0, 0};
  std::array<double, 3> bias = {0, 0, 0};
  std::array<double, 2> control = {-none, none};
  std::array<double, 2> force = {-none, none};  ///< of the clamp [N m or N]
  int sum = -1;       ///< index of the BoundedSum that contains it; -1: none
  int actuator = -1;  ///< index in the robot

  /// Range of forces over all controls, at rest.
  /// q  all DOFs of the robot [rad or m]
  EffortRange force_at_rest(const Eigen::Ref<const Eigen::VectorXd>& q) const;
  /// Does its force depend on position or velocity?
  bool is_servo() const { return bias[1] != 0 || bias[2] != 0 || gain[1] != 0 || gain[2] != 0; }
};

/// effort = factor * clamp(sum of the efforts of some terms)
struct BoundedSum {
  double factor = 1;
  std::array<double, 2> bounds = {-DriveTerm::none, DriveTerm::none};  ///< [N m or N]
};

/// The drive of a DOF.
struct DofDrive {
  using Dofs = Eigen::Ref<const Eigen::VectorXd>;

  std::vector<DriveTerm> terms;  ///< one per actuator and target; empty: a motor without a law
  std::vector<BoundedSum> sums;  ///< bounded by limits of joints and tendons
  double max_effort = 0;         ///< bound on the total in either direction; 0: no limit [N m or N]

  /// Range of efforts that it can exert at rest.
  /// q  all DOFs of the robot [rad or m]
  EffortRange at_rest(const Dofs& q) const;
  /// The same before limits of force are applied.
  EffortRange commanded(const Dofs& q) const;
  /// Range of efforts that it can exert at any position and velocity. For a servo, only force
  /// limits apply: its control limits act on its position and velocity.
  EffortRange limits() const;
  bool has_servo() const;
  /// Can it exert an effort that depends on a control?
  bool acts() const;
};

/// The drive of a DOF through the actuators of the robot; without any, a motor that exerts up to
/// its `max_effort`. For actuators of unknown law only force limits are used.
DofDrive drive_of(const RobotSpec& robot, int dof);

/// Can the actuator exert no effort on its target by any control? Its gear, gain or a range is 0,
/// or it is not enabled.
bool is_powerless(const ActuatorSpec& actuator);

}  // namespace clench
