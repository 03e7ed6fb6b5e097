// Range of the force that the drive of a DOF can exert, from the laws and limits of its actuators.
#pragma once
#include <array>
#include <limits>
#include <vector>

#include "clench/model/robot.h"

namespace clench {

/// Efforts from low to high; infinite where no limit is given [N m or N].
struct EffortRange {
  double low = 0, high = 0;

  bool is_zero() const { return low == 0 && high == 0; }
  bool operator==(const EffortRange&) const = default;
};

/// An actuator as its DOF feels it: effort = reach * clamp(gain * control + bias[0] + bias[1] *
/// length + bias[2] * velocity), length = reach * q, with the control within its range.
struct DriveTerm {
  static constexpr double none = std::numeric_limits<double>::infinity();

  double reach = 1;  ///< change of the actuator's length per unit of the DOF
  double gain = 1;
  std::array<double, 3> bias = {0, 0, 0};
  std::array<double, 2> control = {-none, none};
  std::array<double, 2> force = {-none, none};  ///< of the clamp [N m or N]

  /// Does its force depend on position or velocity?
  bool is_servo() const { return bias[1] != 0 || bias[2] != 0; }
};

/// The drive of a DOF.
struct DofDrive {
  std::vector<DriveTerm> terms;  ///< one per actuator; none: a motor without a law
  double max_effort = 0;  ///< either direction, of all terms together; 0: no limit [N m or N]

  /// Efforts that it can exert at rest at q.
  EffortRange at_rest(double q) const;
  /// Efforts at rest at q before the limits of force clamp them.
  EffortRange commanded(double q) const;
  /// Efforts that it can exert at any position and velocity. Only the force limits of a servo
  /// count: its control limits act on its position and velocity.
  EffortRange limits() const;
  bool has_servo() const;
  /// Can it exert an effort that a control changes?
  bool acts() const;
};

/// The drive of a DOF; of one that is not driven, that of a motor which a script adds. Actuators of
/// unknown law count by their force limits alone; so do those on tendons, whose coefficients count as
/// positive. One whose gear is 0, or whose gain and bias are 0, exerts nothing.
DofDrive drive_of(const Robot& robot, int dof);

}  // namespace clench
