#include "clench/io/graspit/robot_parts.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/units.h"
#include "clench/spec/valid.h"

namespace clench {

void check_class(const std::string& name, const Place& place, const Diagnostics& diagnostics) {
  static const std::vector<std::string> classes = {
      "Robot", "Hand",   "Puma560",   "Barrett", "Robonaut", "Pr2Gripper", "Pr2Gripper2010",
      "M7",    "M7Tool", "HumanHand", "Shadow",  "McGrip",   "RobotIQ"};
  if (!diagnostics || std::ranges::find(classes, name) != classes.end()) return;
  diagnostics.warn(place.of("robot"), "unknown type {} has no meaning{}", in_quotes(name),
                   did_you_mean(name, classes));
}

DofKind dof_kind(std::string_view letter, const std::string& subject) {
  if (letter == "r") return DofKind::rigid;
  if (letter == "b") return DofKind::breakaway;
  if (letter == "c") return DofKind::compliant;
  fail("{}: expected type r, b or c, got {}", subject, in_quotes(letter));
}

DofSpec in_si(DofSpec dof, bool slides) {
  dof.default_velocity *= slides ? units::millimeter : 1.0;
  dof.default_value *= slides ? units::millimeter : units::degree;
  dof.max_effort *= slides ? units::gram_millimeter : units::gram_square_millimeter;
  dof.kp *= slides ? units::gram_per_square_second : units::gram_square_millimeter;
  dof.kd *= slides ? units::gram : units::gram_square_millimeter;
  dof.dragger_scale *= units::millimeter;
  return dof;
}

JointExpression expected_expression(std::string_view text, JointKind kind, size_t dofs,
                                    const std::string& subject) {
  const auto expression = parse_joint_expression(text);
  if (!expression)
    fail("{}: expected a joint expression such as d0*0.5+90 for {}, got {}", subject,
         kind == JointKind::revolute ? "theta" : "d", in_quotes(text));
  if (expression->dof >= static_cast<int>(dofs))
    fail("{}: expected a DOF below {}, got d{}", subject, dofs, expression->dof);
  if (expression->ratio == 0)
    fail("{}: expected a ratio other than 0, got {}", subject, in_quotes(text));
  return *expression;
}

int joints_of_kind(std::string_view word) {
  const std::vector<std::string> names = {"Revolute", "Prismatic", "Universal", "Ball", "Fixed"};
  constexpr int joints[] = {1, 1, 2, 3, 0};
  for (size_t i = 0; i < names.size(); ++i)
    if (lower_case(names[i]) == lower_case(word)) return joints[i];
  fail("expected Revolute, Prismatic, Universal, Ball or Fixed, got {}{}", in_quotes(word),
       did_you_mean(word, names));
}

static JointSpec in_si(JointSpec joint) {
  const bool turns = joint.kind == JointKind::revolute;
  joint.min *= turns ? units::degree : units::millimeter;
  joint.max *= turns ? units::degree : units::millimeter;
  joint.viscous *= turns ? units::gram_square_millimeter : units::gram;
  joint.coulomb *= turns ? units::gram_square_millimeter : units::gram_millimeter;
  joint.spring *= turns ? units::newton_millimeter : units::newton_per_millimeter;
  joint.rest *= turns ? 1.0 : units::millimeter;
  return joint;
}

// Rz(theta) Tz(d) Tx(a) Rx(alpha)
static Pose pose_of(const DenavitHartenberg& n) {
  const Eigen::Quaterniond about_z(Eigen::AngleAxisd(n.theta, Eigen::Vector3d::UnitZ()));
  const Eigen::Quaterniond about_x(Eigen::AngleAxisd(n.alpha, Eigen::Vector3d::UnitX()));
  return {about_z * about_x, {n.a * std::cos(n.theta), n.a * std::sin(n.theta), n.d}};
}

void ChainLinks::add_joint(JointSpec joint, const DenavitHartenberg& written) {
  auto& kind = dof_kinds_[joint.dof];
  if (!kind) kind = joint.kind;
  if (*kind != joint.kind)
    joint.ratio *= joint.kind == JointKind::revolute ? 1 / units::millimeter : units::millimeter;
  const DenavitHartenberg numbers = {.theta = written.theta * units::degree,
                                     .d = written.d * units::millimeter,
                                     .a = written.a * units::millimeter,
                                     .alpha = written.alpha * units::degree};
  const std::string subject = fmt::format("joint {}", joints());
  check_each(angle_rule, {{"theta", numbers.theta}, {"alpha", numbers.alpha}}, subject);
  check_each(coordinate_rule, {{"d", numbers.d}, {"a", numbers.a}}, subject);
  joints_.push_back(in_si(std::move(joint)));
  after_.push_back(pose_of(numbers));
}

void ChainLinks::add_link(const BodySpec& body, int last_joint, RobotSpec& robot) {
  LinkSpec link{.body = body, .parent = parent_};
  for (; used_ <= last_joint; ++used_) {
    link.joints.push_back(joints_[used_]);
    link.joints.back().X_PJ = at_;
    at_ = after_[used_];
  }
  link.X_JL = at_;
  at_ = {};
  parent_ = static_cast<int>(robot.links.size());
  robot.links.push_back(std::move(link));
}

}  // namespace clench
