#include "spec/robot_spec.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"

namespace clench {

Pose approach_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  const double length = direction.stableNorm();
  if (!point.allFinite() || !std::isfinite(length) || length < 1e-9)
    fail("approach direction: expected a direction, got ({}, {}, {})", direction.x(), direction.y(),
         direction.z());
  const Eigen::Vector3d z = direction / length;
  const Eigen::Vector3d x0 =
      std::abs(z.x()) > 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = z.cross(x0).normalized();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  return {Eigen::Quaterniond(axes).normalized(), point};
}

std::array<double, 2> dof_range(const RobotSpec& robot, int dof) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& chain : robot.chains)
    for (const auto& joint : chain.joints) {
      if (joint.dof != dof) continue;
      const double a = joint.min / joint.ratio, b = joint.max / joint.ratio;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
  // a DOF without joints stays where it is
  if (!std::isfinite(low)) return {0, 0};
  return {low, high};
}

std::string no_range(const std::array<double, 2>& range) {
  return fmt::format("expected a range that all of its joints allow, got from {:.6g} to {:.6g}",
                     range[0], range[1]);
}

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
              {"breakaway torque", dof.breakaway_torque}},
             subject);
}

static void check_joint(const JointSpec& joint, const RobotSpec& robot,
                        const std::string& subject) {
  const int dofs = static_cast<int>(robot.dofs.size());
  if (joint.dof < 0 || joint.dof >= dofs)
    fail("{}: expected a DOF from 0 to {}, got {}", subject, dofs - 1, joint.dof);
  check_name(joint.name, subject);
  check_each(angle_rule, {{"theta", joint.theta}, {"alpha", joint.alpha}}, subject);
  check_each(coordinate_rule, {{"d", joint.d}, {"a", joint.a}}, subject);
  check_each(limit_rule, {{"min", joint.min}, {"max", joint.max}, {"rest value", joint.rest}},
             subject);
  check_place(joint.X_before, subject);
  check_place(joint.X_after, subject);
  if (joint.ratio == 0) fail("{}: expected a ratio other than 0, got 0", subject);
  check(positive_rule.called("ratio"), std::abs(joint.ratio), subject);
  check(number_rule.called("pull"), joint.pull, subject);
  if (joint.min > joint.max)
    fail("{}: min {} exceeds max {} [{}]", subject, joint.min, joint.max,
         joint.kind == JointKind::revolute ? "rad" : "m");
  check_each(not_negative_rule,
             {{"viscous friction", joint.viscous},
              {"Coulomb friction", joint.coulomb},
              {"spring", joint.spring}},
             subject);
}

static bool has_part(const RobotSpec& robot, const RobotPart& part) {
  if (part.chain < 0) return part.chain == -1 && part.link == -1;
  return part.chain < static_cast<int>(robot.chains.size()) && part.link >= 0 &&
         part.link < static_cast<int>(robot.chains[part.chain].links.size());
}

static void check_part(const RobotSpec& robot, const RobotPart& part, const char* subject) {
  if (!has_part(robot, part))
    fail("{}: {}: no link {} of chain {}", excerpt(robot.name), subject, part.link, part.chain);
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

static void check_parts(const RobotSpec& robot) {
  for (const auto& part : robot.collision_rules.parts_off)
    check_part(robot, part, "collision rule");
  for (const auto& pair : robot.collision_rules.pairs_off)
    for (const auto& part : pair) check_part(robot, part, "collision rule");
  for (const auto& sensor : robot.tactile) {
    check_part(robot, sensor.part, "tactile sensor");
    check(coordinate_rule, sensor.low_L, excerpt(robot.name) + ": tactile sensor");
    check(coordinate_rule, sensor.high_L, excerpt(robot.name) + ": tactile sensor");
  }
  for (const auto& wrapper : robot.wrappers) check_part(robot, wrapper.part, "tendon wrapper");
  for (const auto& tendon : robot.tendons)
    for (const auto& point : tendon.points) check_part(robot, point.part, "tendon");
}

void check_fit(const RobotSpec& robot, const EigengraspSet& set) {
  if (set.dofs != static_cast<int>(robot.dofs.size()))
    fail("eigengrasps of {} DOFs do not fit '{}', which has {}", set.dofs, excerpt(robot.name),
         robot.dofs.size());
}

void check_fit(const RobotSpec& robot, const VirtualContactSet& set) {
  const int chains = static_cast<int>(robot.chains.size());
  for (size_t i = 0; i < set.contacts.size(); ++i) {
    const auto& [chain, link, pose, mu, edges] = set.contacts[i];
    if (chain == -1 && link == 0) continue;
    if (chain < 0 || chain >= chains)
      fail("contact {}: '{}' has no chain {}", i + 1, excerpt(robot.name), chain);
    if (link < 0 || link >= static_cast<int>(robot.chains[chain].links.size()))
      fail("contact {}: chain {} of '{}' has no link {}", i + 1, chain, excerpt(robot.name), link);
  }
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
  if (robot.virtual_contacts) {
    check_fit(robot, *robot.virtual_contacts);
    for (size_t i = 0; i < robot.virtual_contacts->contacts.size(); ++i)
      check_virtual_contact(robot.virtual_contacts->contacts[i],
                            fmt::format("{}: virtual contact {}", name, i + 1));
  }
  if (!robot.glove) return;
  check_fit(robot, *robot.glove);
  const std::string glove = name + ": glove";
  for (const double x : robot.glove->slopes.reshaped())
    check(number_rule.called("slope"), x, glove);
  for (const double x : robot.glove->intercepts) check(number_rule.called("intercept"), x, glove);
}

static void check_bodies(const RobotSpec& robot, const std::string& name) {
  for (const std::string* other : {&robot.class_name, &robot.database_name})
    check_name(*other, name);
  check_body(robot.base, name + ": base");
  for (const ChainSpec& chain : robot.chains)
    for (const LinkSpec& link : chain.links) check_body(link.body, name + ": link");
  if (robot.X_BA) check_place(*robot.X_BA, name + ": approach");
  if (robot.tracker) check_place(robot.tracker->X_BS, name + ": tracker");
}

void check_robot(const RobotSpec& robot) {
  check_name(robot.name, "robot");
  const std::string name = excerpt(robot.name);
  check_sets(robot, name);
  check_bodies(robot, name);
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    check_dof(robot.dofs[i], fmt::format("{}: DOF {}", name, i));
  for (size_t c = 0; c < robot.chains.size(); ++c) {
    const ChainSpec& chain = robot.chains[c];
    const std::string place = fmt::format("{}: chain {}", name, c);
    check_place(chain.X_BC, place);
    if (chain.parent_chain < -1 || chain.parent_chain >= static_cast<int>(c))
      fail("{}: expected to begin on the base or on a chain before it, got chain {}", place,
           chain.parent_chain);
    if (chain.parent_chain >= 0) {
      const int links = static_cast<int>(robot.chains[chain.parent_chain].links.size());
      if (chain.parent_link < 0 || chain.parent_link >= links)
        fail("{}: expected to begin on one of {} links of chain {}, got {}", place, links,
             chain.parent_chain, chain.parent_link);
    }
    for (size_t j = 0; j < chain.joints.size(); ++j)
      check_joint(chain.joints[j], robot, fmt::format("{} joint {}", place, j));
    const int joints = static_cast<int>(chain.joints.size());
    for (size_t l = 0; l < chain.links.size(); ++l) {
      if (const int last = chain.links[l].last_joint; last < -1 || last >= joints)
        fail("{} link {}: expected a last joint from -1 to {}, got {}", place, l, joints - 1, last);
      if (chain.links[l].X_JL)
        check_place(*chain.links[l].X_JL, fmt::format("{} link {}", place, l));
    }
  }
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    if (const auto range = dof_range(robot, static_cast<int>(i)); range[0] > range[1])
      fail("{}: DOF {}: {}", name, i, no_range(range));
  check_parts(robot);
  check_tendons(robot);
}

}  // namespace clench
