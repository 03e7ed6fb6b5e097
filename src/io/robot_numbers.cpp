#include "io/robot_numbers.h"

#include <cmath>

#include "base/error.h"
#include "base/units.h"
#include "io/world_parts.h"

namespace clench {

DofTexts dof_texts(const RobotSpec& robot, int number) {
  const DofSpec& dof = robot.dofs[number];
  const bool slides = dof_slides(robot, number);
  DofTexts out;
  out.kind = dof.kind == DofKind::breakaway ? 'b' : dof.kind == DofKind::compliant ? 'c' : 'r';
  out.velocity = number_in(dof.default_velocity, slides ? units::millimetre : 1.0);
  out.effort =
      number_in(dof.max_effort, slides ? units::gram_millimetre : units::gram_square_millimetre);
  out.kp =
      number_in(dof.kp, slides ? units::gram_per_square_second : units::gram_square_millimetre);
  out.kd = number_in(dof.kd, slides ? units::gram : units::gram_square_millimetre);
  out.scale = number_in(dof.dragger_scale, units::millimetre);
  out.breakaway = number_in(dof.breakaway_torque, 1.0);
  out.value = number_in(dof.default_value, slides ? units::millimetre : units::degree);
  return out;
}

std::string words(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

static std::string expression(const JointSpec& joint, double ratio_unit, double offset,
                              double unit) {
  std::string out = fmt::format("d{}", joint.dof);
  const double written = joint.pull != 0 ? joint.pull : joint.ratio;
  if (const std::string ratio = number_in(written, ratio_unit); ratio != "1") (out += '*') += ratio;
  // "+-5": the original loses what follows a bare minus
  if (offset != 0) (out += '+') += number_in(offset, unit);
  return out;
}

JointTexts joint_texts(const RobotSpec& robot, const JointSpec& joint) {
  const bool revolute = joint.kind == JointKind::revolute;
  const double unit = revolute ? units::degree : units::millimetre;
  // a DOF counts in the unit of its first joint: rad or mm
  const bool mixed = dof_slides(robot, joint.dof) == revolute;
  const double ratio_unit = !mixed ? 1 : revolute ? 1 / units::millimetre : units::millimetre;
  JointTexts out;
  out.theta = revolute ? expression(joint, ratio_unit, joint.theta, unit)
                       : number_in(joint.theta, units::degree);
  out.d = revolute ? number_in(joint.d, units::millimetre)
                   : expression(joint, ratio_unit, joint.d, unit);
  out.a = number_in(joint.a, units::millimetre);
  out.alpha = number_in(joint.alpha, units::degree);
  out.min = number_in(joint.min, unit);
  out.max = number_in(joint.max, unit);
  out.viscous = number_in(joint.viscous, revolute ? units::gram_square_millimetre : units::gram);
  out.coulomb =
      number_in(joint.coulomb, revolute ? units::gram_square_millimetre : units::gram_millimetre);
  out.spring =
      number_in(joint.spring, revolute ? units::newton_millimetre : units::newton_per_millimetre);
  out.rest = number_in(joint.rest, revolute ? 1.0 : units::millimetre);
  return out;
}

}  // namespace clench
