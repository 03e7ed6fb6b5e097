#include "spec/robot_spec.h"

#include <cmath>
#include <limits>

#include "base/error.h"

namespace clench {

Pose approach_frame(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) {
  const double length = direction.stableNorm();
  if (!point.allFinite() || !std::isfinite(length) || length < 1e-9)
    fail("approach direction: wanted a direction, got ({}, {}, {})", direction.x(), direction.y(),
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
  return fmt::format("wanted a range that all of its joints allow, got from {:.6g} to {:.6g}",
                     range[0], range[1]);
}

static void check_dof(const DofSpec& dof, const std::string& subject) {
  for (const double x :
       {dof.default_velocity, dof.kp, dof.kd, dof.dragger_scale, dof.default_value}) {
    if (!std::isfinite(x)) fail("{}: wanted finite numbers, got {}", subject, x);
    if (std::abs(x) > largest_number)
      fail("{}: wanted numbers of at most {}, got {}", subject, largest_number, x);
  }
  if (!(dof.max_effort >= 0)) fail("{}: max effort must be >= 0, got {}", subject, dof.max_effort);
  if (!(dof.max_velocity >= 0))
    fail("{}: max velocity must be >= 0, got {}", subject, dof.max_velocity);
  if (!(dof.breakaway_torque >= 0))
    fail("{}: breakaway torque must be >= 0, got {}", subject, dof.breakaway_torque);
}

static void check_joint(const JointSpec& joint, const RobotSpec& robot,
                        const std::string& subject) {
  const int dofs = static_cast<int>(robot.dofs.size());
  if (joint.dof < 0 || joint.dof >= dofs)
    fail("{}: wanted a DOF from 0 to {}, got {}", subject, dofs - 1, joint.dof);
  for (const double x :
       {joint.theta, joint.d, joint.a, joint.alpha, joint.min, joint.max, joint.rest})
    if (!std::isfinite(x)) fail("{}: wanted finite numbers, got {}", subject, x);
  // lengths whose squares and products overflow are no lengths
  for (const double x :
       {joint.theta, joint.d, joint.a, joint.alpha, joint.min, joint.max, joint.rest})
    if (std::abs(x) > largest_number)
      fail("{}: wanted numbers of at most {}, got {}", subject, largest_number, x);
  if (!joint.X_before.is_finite() || !joint.X_after.is_finite())
    fail("{}: wanted finite poses before and after it", subject);
  if (joint.ratio == 0 || !std::isfinite(joint.ratio))
    fail("{}: wanted a ratio other than 0, got {}", subject, joint.ratio);
  if (joint.min > joint.max)
    fail("{}: min {} exceeds max {} [{}]", subject, joint.min, joint.max,
         joint.kind == JointKind::revolute ? "rad" : "m");
  if (!std::isfinite(joint.max / joint.ratio - joint.min / joint.ratio))
    fail("{}: wanted a ratio that leaves DOF {} a finite range, got {}", subject, joint.dof,
         joint.ratio);
  for (const double x : {joint.viscous, joint.coulomb, joint.spring})
    if (!(x >= 0) || !std::isfinite(x))
      fail("{}: friction and spring must be >= 0, got {}", subject, x);
}

static bool has_part(const RobotSpec& robot, const RobotPart& part) {
  if (part.chain < 0) return part.chain == -1 && part.link == -1;
  return part.chain < static_cast<int>(robot.chains.size()) && part.link >= 0 &&
         part.link < static_cast<int>(robot.chains[part.chain].links.size());
}

static void check_part(const RobotSpec& robot, const RobotPart& part, const char* subject) {
  if (!has_part(robot, part))
    fail("{}: {}: no link {} of chain {}", robot.name, subject, part.link, part.chain);
}

static void check_parts(const RobotSpec& robot) {
  for (const auto& part : robot.collision_rules.parts_off)
    check_part(robot, part, "collision rule");
  for (const auto& pair : robot.collision_rules.pairs_off)
    for (const auto& part : pair) check_part(robot, part, "collision rule");
  for (const auto& sensor : robot.tactile) check_part(robot, sensor.part, "tactile sensor");
  for (const auto& wrapper : robot.wrappers) check_part(robot, wrapper.part, "tendon wrapper");
  for (const auto& tendon : robot.tendons)
    for (const auto& point : tendon.points) check_part(robot, point.part, "tendon");
}

void check_fit(const RobotSpec& robot, const EigengraspSet& set) {
  if (set.dofs != static_cast<int>(robot.dofs.size()))
    fail("eigengrasps of {} DOFs do not fit '{}', which has {}", set.dofs, robot.name,
         robot.dofs.size());
}

void check_fit(const RobotSpec& robot, const VirtualContactSet& set) {
  const int chains = static_cast<int>(robot.chains.size());
  for (size_t i = 0; i < set.contacts.size(); ++i) {
    const auto& [chain, link, pose, mu, edges] = set.contacts[i];
    if (chain == -1 && link == 0) continue;
    if (chain < 0 || chain >= chains)
      fail("contact {}: '{}' has no chain {}", i + 1, robot.name, chain);
    if (link < 0 || link >= static_cast<int>(robot.chains[chain].links.size()))
      fail("contact {}: chain {} of '{}' has no link {}", i + 1, chain, robot.name, link);
  }
}

void check_fit(const RobotSpec& robot, const GloveCalibration& glove) {
  const int dofs = static_cast<int>(robot.dofs.size());
  if (glove.slopes.rows() != dofs || glove.intercepts.size() != dofs)
    fail("a glove's calibration for {} DOFs does not fit '{}', which has {}", glove.slopes.rows(),
         robot.name, dofs);
}

static void check_sets(const RobotSpec& robot) {
  if (robot.eigengrasps) {
    check_fit(robot, *robot.eigengrasps);
    check_eigengrasps(*robot.eigengrasps, robot.name);
  }
  if (robot.virtual_contacts) {
    check_fit(robot, *robot.virtual_contacts);
    for (size_t i = 0; i < robot.virtual_contacts->contacts.size(); ++i)
      check_virtual_contact(robot.virtual_contacts->contacts[i],
                            fmt::format("{}: virtual contact {}", robot.name, i + 1));
  }
  if (robot.glove) check_fit(robot, *robot.glove);
}

static void check_part_mass(const RobotSpec& robot, const BodySpec& part) {
  if (!(part.mass >= 0) || part.mass > largest_number)
    fail("{}: '{}': its mass must lie in [0, {}] [kg], got {}", robot.name, part.name,
         largest_number, part.mass);
}

void check_robot(const RobotSpec& robot) {
  check_sets(robot);
  check_part_mass(robot, robot.base);
  for (const ChainSpec& chain : robot.chains)
    for (const LinkSpec& link : chain.links) check_part_mass(robot, link.body);
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    check_dof(robot.dofs[i], fmt::format("{}: DOF {}", robot.name, i));
  for (size_t c = 0; c < robot.chains.size(); ++c) {
    const ChainSpec& chain = robot.chains[c];
    const std::string place = fmt::format("{}: chain {}", robot.name, c);
    if (!chain.X_BC.is_finite()) fail("{}: wanted a finite pose of its base", place);
    if (chain.parent_chain < -1 || chain.parent_chain >= static_cast<int>(c))
      fail("{}: wanted to begin on the base or on a chain before it, got chain {}", place,
           chain.parent_chain);
    if (chain.parent_chain >= 0) {
      const int links = static_cast<int>(robot.chains[chain.parent_chain].links.size());
      if (chain.parent_link < 0 || chain.parent_link >= links)
        fail("{}: wanted to begin on one of {} links of chain {}, got {}", place, links,
             chain.parent_chain, chain.parent_link);
    }
    for (size_t j = 0; j < chain.joints.size(); ++j)
      check_joint(chain.joints[j], robot, fmt::format("{} joint {}", place, j));
    const int joints = static_cast<int>(chain.joints.size());
    for (size_t l = 0; l < chain.links.size(); ++l) {
      if (const int last = chain.links[l].last_joint; last < -1 || last >= joints)
        fail("{} link {}: wanted a last joint from -1 to {}, got {}", place, l, joints - 1, last);
      if (chain.links[l].X_JL && !chain.links[l].X_JL->is_finite())
        fail("{} link {}: wanted a finite pose after its last joint", place, l);
    }
  }
  for (size_t i = 0; i < robot.dofs.size(); ++i)
    if (const auto range = dof_range(robot, static_cast<int>(i)); range[0] > range[1])
      fail("{}: DOF {}: {}", robot.name, i, no_range(range));
  check_parts(robot);
}

}  // namespace clench
