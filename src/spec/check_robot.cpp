#include "clench/spec/check_robot.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/base/text.h"

namespace clench {

static void check_dof(const DofSpec& dof, const std::string& subject) {
  check_name(dof.name, subject);
  check(limit_rule.called("default value"), dof.default_value, subject);
  check_each(number_rule,
             {{"default velocity", dof.default_velocity},
              {"Kp", dof.kp},
              {"Kd", dof.kd},
              {"dragger scale", dof.dragger_scale}},
             subject);
  check_each(not_negative_rule,
             {{"max effort", dof.max_effort},
              {"max velocity", dof.max_velocity},
              {"damping ratio", dof.damping_ratio},
              {"breakaway torque", dof.breakaway_torque}},
             subject);
}

static void check_joint(const JointSpec& joint, const RobotSpec& robot,
                        const std::string& subject) {
  const int dofs = static_cast<int>(robot.dofs.size());
  if (joint.dof < 0 || joint.dof >= dofs)
    fail("{}: expected a DOF from 0 to {}, got {}", subject, dofs - 1, joint.dof);
  check_name(joint.name, subject);
  check_each(limit_rule, {{"min", joint.min}, {"max", joint.max}, {"rest value", joint.rest}},
             subject);
  check_place(joint.X_PJ, subject);
  if (!(std::abs(joint.axis.norm() - 1) < 1e-9))
    fail("{}: expected an axis of length 1, got ({}, {}, {})", subject, joint.axis.x(),
         joint.axis.y(), joint.axis.z());
  if (joint.ratio == 0) fail("{}: expected a ratio other than 0, got 0", subject);
  check(positive_rule.called("ratio"), std::abs(joint.ratio), subject);
  if (joint.min > joint.max)
    fail("{}: min {} exceeds max {} [{}]", subject, joint.min, joint.max,
         joint.kind == JointKind::revolute ? "rad" : "m");
  check_each(not_negative_rule,
             {{"viscous friction", joint.viscous},
              {"Coulomb friction", joint.coulomb},
              {"armature", joint.armature},
              {"spring", joint.spring}},
             subject);
  if (!joint.effort_range) return;
  for (const double end : *joint.effort_range) check(number_rule.called("effort"), end, subject);
  if ((*joint.effort_range)[0] > (*joint.effort_range)[1])
    fail("{}: lowest effort {} exceeds {}", subject, (*joint.effort_range)[0],
         (*joint.effort_range)[1]);
}

static void check_part(const RobotSpec& robot, int link, const char* subject) {
  if (link < -1 || link >= static_cast<int>(robot.links.size()))
    fail("{}: {}: expected one of {} links, or -1 for the base, got {}", excerpt(robot.name),
         subject, robot.links.size(), link);
}

static void check_tendons(const RobotSpec& robot) {
  for (const TendonSpec& tendon : robot.tendons) {
    check_name(tendon.name, excerpt(robot.name) + ": tendon");
    const std::string subject =
        fmt::format("{}: tendon '{}'", excerpt(robot.name), excerpt(tendon.name));
    check(not_negative_rule.called("stiffness"), tendon.stiffness, subject);
    for (const auto& length : {tendon.rest_length, tendon.pre_tension_length})
      check(not_negative_rule.called("length"), length.value_or(0), subject);
    for (const TendonPoint& point : tendon.points) {
      check(coordinate_rule, point.p_L, subject);
      check(friction_rule, point.friction, subject);
    }
  }
  for (size_t i = 0; i < robot.wrappers.size(); ++i) {
    const TendonWrapper& wrapper = robot.wrappers[i];
    const std::string subject = fmt::format("{}: tendon wrapper {}", excerpt(robot.name), i);
    check(coordinate_rule, wrapper.p_L, subject);
    check(coordinate_rule.called("axis"), wrapper.axis_L, subject);
    check(not_negative_rule.called("radius"), wrapper.radius, subject);
    check(not_negative_rule.called("length"), wrapper.length, subject);
    check(friction_rule, wrapper.friction, subject);
  }
}

static void check_joint_tendons(const RobotSpec& robot) {
  const int dofs = static_cast<int>(robot.dofs.size());
  for (const JointTendonSpec& tendon : robot.joint_tendons) {
    check_name(tendon.name, excerpt(robot.name) + ": joint tendon");
    const std::string subject =
        fmt::format("{}: joint tendon '{}'", excerpt(robot.name), excerpt(tendon.name));
    std::vector<bool> seen(robot.dofs.size());
    for (const auto& [dof, arm] : tendon.arms) {
      if (dof < 0 || dof >= dofs)
        fail("{}: expected a DOF from 0 to {}, got {}", subject, dofs - 1, dof);
      if (seen[dof]) fail("{}: expected each DOF once, got DOF {} twice", subject, dof);
      seen[dof] = true;
      check(positive_rule.called("arm"), std::abs(arm), subject);
    }
    check_each(not_negative_rule,
               {{"stiffness", tendon.stiffness},
                {"damping", tendon.damping},
                {"friction", tendon.friction}},
               subject);
    for (const auto& range : {tendon.range, std::optional(tendon.slack)}) {
      if (!range) continue;
      check_each(number_rule, {{"length", (*range)[0]}, {"length", (*range)[1]}}, subject);
      if ((*range)[0] > (*range)[1])
        fail("{}: length {} exceeds {}", subject, (*range)[0], (*range)[1]);
    }
  }
}

static void check_parts(const RobotSpec& robot) {
  for (const int part : robot.collision_rules.parts_off) check_part(robot, part, "collision rule");
  for (const auto* pairs : {&robot.collision_rules.pairs_off, &robot.collision_rules.pairs_on})
    for (const auto& pair : *pairs)
      for (const int part : pair) check_part(robot, part, "collision rule");
  for (const auto& sensor : robot.tactile) {
    check_part(robot, sensor.link, "tactile sensor");
    check(coordinate_rule, sensor.low_L, excerpt(robot.name) + ": tactile sensor");
    check(coordinate_rule, sensor.high_L, excerpt(robot.name) + ": tactile sensor");
  }
  for (const auto& wrapper : robot.wrappers) check_part(robot, wrapper.link, "tendon wrapper");
  for (const auto& tendon : robot.tendons)
    for (const auto& point : tendon.points) check_part(robot, point.link, "tendon");
}

void check_fit(const RobotSpec& robot, const EigengraspSet& set) {
  if (set.dofs != static_cast<int>(robot.dofs.size()))
    fail("eigengrasps of {} DOFs do not fit '{}', which has {}", set.dofs, excerpt(robot.name),
         robot.dofs.size());
}

void check_fit(const RobotSpec& robot, const GloveCalibration& glove) {
  const int dofs = static_cast<int>(robot.dofs.size());
  if (glove.slopes.rows() != dofs || glove.intercepts.size() != dofs)
    fail("a glove's calibration for {} DOFs does not fit '{}', which has {}", glove.slopes.rows(),
         excerpt(robot.name), dofs);
}

static void check_sets(const RobotSpec& robot, const std::string& name) {
  if (robot.eigengrasps) {
    check_fit(robot, *robot.eigengrasps);
    check_eigengrasps(*robot.eigengrasps, name);
  }
  for (size_t i = 0; robot.virtual_contacts && i < robot.virtual_contacts->size(); ++i) {
    const VirtualContactSpec& contact = (*robot.virtual_contacts)[i];
    check_virtual_contact(contact, fmt::format("{}: virtual contact {}", name, i + 1));
    check_part(robot, contact.link, "virtual contact");
  }
  if (!robot.glove) return;
  check_fit(robot, *robot.glove);
  const std::string glove = name + ": glove";
  for (const double x : robot.glove->slopes.reshaped())
    check(number_rule.called("slope"), x, glove);
  for (const double x : robot.glove->intercepts) check(number_rule.called("intercept"), x, glove);
}

static void check_actuators(const RobotSpec& robot, const std::string& name) {
  for (size_t i = 0; i < robot.actuators.size(); ++i) {
    const ActuatorSpec& actuator = robot.actuators[i];
    const std::string subject = fmt::format("{}: actuator {}", name, i + 1);
    for (const std::string* text :
         {&actuator.name, &actuator.kind, &actuator.joint, &actuator.tendon})
      check_name(*text, subject);
    const int dofs = static_cast<int>(robot.dofs.size());
    if (actuator.dof < -1 || actuator.dof >= dofs)
      fail("{}: expected a DOF from 0 to {}, or -1 for none, got {}", subject, dofs - 1,
           actuator.dof);
    check_each(number_rule,
               {{"gear", actuator.gear},
                {"gain", actuator.gain},
                {"bias", actuator.bias[0]},
                {"bias", actuator.bias[1]},
                {"bias", actuator.bias[2]},
                {"gain slope", actuator.gain_slopes[0]},
                {"gain slope", actuator.gain_slopes[1]},
                {"length", actuator.length_at_0}},
               subject);
    for (const TendonPull& pull : actuator.pulls) {
      check_name(pull.joint, subject);
      check(number_rule.called("coefficient"), pull.coefficient, subject);
    }
    for (const auto& range :
         {actuator.control_range, actuator.force_range, actuator.tendon_force_range})
      if (range) check_each(number_rule, {{"range", (*range)[0]}, {"range", (*range)[1]}}, subject);
    // an end may be infinite
    for (const auto& range : {actuator.activation_range, actuator.law_range})
      for (const double end : range.value_or(std::array{0.0, 0.0}))
        if (!std::isinf(end)) check(number_rule.called("range"), end, subject);
  }
}

static void check_bodies(const RobotSpec& robot, const std::string& name) {
  for (const std::string* other : {&robot.class_name, &robot.database_name})
    check_name(*other, name);
  check_body(robot.base, name + ": base");
  for (const LinkSpec& link : robot.links) check_body(link.body, name + ": link");
  if (robot.X_BA) check_place(*robot.X_BA, name + ": approach");
  if (robot.tracker) check_place(robot.tracker->X_BS, name + ": tracker");
}

static void check_link(const RobotSpec& robot, int number, const std::string& name) {
  const LinkSpec& link = robot.links[number];
  const std::string place = fmt::format("{}: link '{}'", name, excerpt(link.body.name));
  if (link.parent < -1 || link.parent >= number)
    fail("{}: expected a parent from -1, the base, to {}, a link before it, got {}", place,
         number - 1, link.parent);
  for (size_t j = 0; j < link.joints.size(); ++j)
    check_joint(link.joints[j], robot, fmt::format("{}: joint {}", place, j));
  check_place(link.X_JL, place);
}

void check_robot(const RobotSpec& robot) {
  check_name(robot.name, "robot");
  const std::string name = excerpt(robot.name);
  check_sets(robot, name);
  check_bodies(robot, name);
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    check_dof(robot.dofs[i], fmt::format("{}: DOF {}", name, i));
  for (int l = 0; l < static_cast<int>(robot.links.size()); ++l) check_link(robot, l, name);
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    if (const auto range = dof_range(robot, static_cast<int>(i)); range[0] > range[1])
      fail("{}: DOF {}: {}", name, i, no_range(range));
  check_parts(robot);
  check_tendons(robot);
  check_joint_tendons(robot);
  check_actuators(robot, name);
}

}  // namespace clench
