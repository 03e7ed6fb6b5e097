#include "clench/model/robot.h"

#include <cmath>

namespace clench {

static void add_links(Robot& robot, const RobotSpec& spec) {
  for (const LinkSpec& link : spec.links) {
    const int first = static_cast<int>(robot.joints.size());
    for (const JointSpec& joint : link.joints)
      robot.joints.push_back({joint, static_cast<int>(robot.links.size())});
    robot.links.push_back(
        {{}, link.parent, first, static_cast<int>(robot.joints.size()), link.X_JL});
  }
}

static void add_drives(Robot& robot, const RobotSpec& spec) {
  // actuators without force drive nothing
  for (int i = 0; i < static_cast<int>(spec.dofs.size()); ++i) {
    DofDrive drive = drive_of(spec, i);
    DofSpec& dof = robot.dofs[i];
    dof.driven = dof.driven && drive.acts();
    robot.drives.push_back(dof.driven ? std::move(drive) : DofDrive{{}, {}, dof.max_effort});
  }
}

Robot make_robot(const RobotSpec& spec) {
  Robot robot;
  robot.name = spec.name;
  robot.source = spec.source;
  robot.file = spec.file;
  robot.class_name = spec.class_name;
  robot.dofs = spec.dofs;
  robot.X_BA = spec.X_BA.value_or(Pose{});
  robot.files = spec.files;
  robot.tracker = spec.tracker;
  robot.joint_tendons = spec.joint_tendons;
  if (PassiveParts parts{spec.tactile, spec.tendons, spec.wrappers, spec.actuators}; !parts.empty())
    robot.passive = std::make_shared<PassiveParts>(std::move(parts));
  if (spec.eigengrasps) robot.eigengrasps = std::make_shared<EigengraspSet>(*spec.eigengrasps);
  if (spec.virtual_contacts)
    robot.virtual_contacts =
        std::make_shared<std::vector<VirtualContactSpec>>(*spec.virtual_contacts);
  if (spec.glove) robot.glove = std::make_shared<GloveCalibration>(*spec.glove);
  add_links(robot, spec);
  add_drives(robot, spec);
  robot.chains = chains_of(spec);
  for (int i = 0; i < static_cast<int>(spec.dofs.size()); ++i) {
    robot.limits.push_back(dof_range(spec, i));
    robot.endless.push_back(dof_is_endless(spec, i));
  }
  return robot;
}

// A pose composed of many; its rotation is normalized once, at the end. Many joint frames of
// GraspIt! robots only have a translation or nothing.
[[gnu::always_inline]] static inline void append(Pose& X, const Pose& next) {
  if (!next.position.isZero(0)) X.position += turned(X.rotation, next.position);
  if (!next.rotation.vec().isZero(0)) X.rotation = X.rotation * next.rotation;
}

[[gnu::always_inline]] static inline void move(Pose& X, const Joint& joint, double q) {
  if (joint.kind == JointKind::prismatic) {
    X.position += turned(X.rotation, q * joint.axis);
    return;
  }
  const Eigen::Vector3d axis = std::sin(0.5 * q) * joint.axis;
  X.rotation = X.rotation * Eigen::Quaterniond(std::cos(0.5 * q), axis.x(), axis.y(), axis.z());
}

void find_frames(const Robot& robot, const Pose& X_base, std::span<const double> q,
                 RobotFrames& out) {
  out.joints.resize(robot.joints.size());
  out.links.resize(robot.links.size());
  for (size_t l = 0; l < robot.links.size(); ++l) {
    const Link& link = robot.links[l];
    Pose X = link.parent < 0 ? X_base : out.links[link.parent];
    for (int j = link.first_joint; j < link.end_joint; ++j) {
      append(X, robot.joints[j].X_PJ);
      out.joints[j] = X;
      move(X, robot.joints[j], q[j]);
    }
    append(X, link.X_JL);
    out.links[l] = {X.rotation.normalized(), X.position};
  }
}

std::vector<int> joints_of(const Robot& robot, const Chain& chain) {
  std::vector<int> out;
  for (const int l : chain.links)
    for (int j = robot.links[l].first_joint; j < robot.links[l].end_joint; ++j) out.push_back(j);
  return out;
}

int number_in_chain(const Robot& robot, int joint) {
  int number = joint - robot.links[robot.joints[joint].link].first_joint;
  const ChainPlace place = place_of(robot.chains, robot.joints[joint].link);
  for (int l = 0; l < place.link; ++l) {
    const Link& before = robot.links[robot.chains[place.chain].links[l]];
    number += before.end_joint - before.first_joint;
  }
  return number;
}

bool joint_moves_link(const Robot& robot, int joint, int link) {
  const int moved = robot.joints[joint].link;
  while (link > moved) link = robot.links[link].parent;
  return link == moved;
}

}  // namespace clench
