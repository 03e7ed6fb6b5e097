#include <iterator>

#include "io/robot_numbers.h"
#include "io/world_parts.h"
#include "io/write_robot_texts.h"

namespace clench {

static const char* link_word(LinkJoint joint) {
  switch (joint) {
    case LinkJoint::revolute:
      return "Revolute";
    case LinkJoint::prismatic:
      return "Prismatic";
    case LinkJoint::universal:
      return "Universal";
    case LinkJoint::ball:
      return "Ball";
    case LinkJoint::fixed:
      break;
  }
  return "Fixed";
}

static std::string dof_line(const RobotSpec& robot, int dof) {
  const DofTexts t = dof_texts(robot, dof);
  std::string out =
      fmt::format("{} {} {} {} {} {}", t.kind, t.velocity, t.effort, t.kp, t.kd, t.scale);
  if (t.kind == "b") out += " " + t.breakaway;
  return out + "\n";
}

static std::string joint_line(const RobotSpec& robot, const JointSpec& joint) {
  const JointTexts t = joint_texts(robot, joint);
  std::string out = fmt::format("{} {} {} {} {} {}", t.theta, t.d, t.a, t.alpha, t.min, t.max);
  // columns from the right on may be absent
  const std::string rest[] = {t.viscous, t.coulomb, t.spring, t.rest};
  int columns = 4;
  while (columns > 0 && rest[columns - 1] == "0") --columns;
  for (int i = 0; i < columns; ++i) out += " " + rest[i];
  return out + "\n";
}

static std::string chain_block(const RobotSpec& robot, const ChainSpec& chain,
                               RobotFolder& folder) {
  std::string out = fmt::format("\n{}\n{}\nT {}\n", chain.joints.size(), chain.links.size(),
                                full_transform(chain.X_BC));
  for (const JointSpec& joint : chain.joints) out += joint_line(robot, joint);
  for (const LinkSpec& link : chain.links)
    out += fmt::format("{}\n{} {}\n", link_word(link.joint),
                       folder.body(link.body, part_name(link.body, robot)), link.last_joint);
  return out;
}

std::string robot_cfg_text(const RobotSpec& robot, RobotFolder& folder) {
  std::string out =
      fmt::format("{}\n{}\n{}\n", class_word(robot),
                  folder.body(robot.base, part_name(robot.base, robot)), robot.dofs.size());
  const auto to = std::back_inserter(out);
  for (size_t d = 0; d < robot.dofs.size(); ++d) out += dof_line(robot, static_cast<int>(d));
  fmt::format_to(to, "\n{}\n", robot.chains.size());
  for (const ChainSpec& chain : robot.chains) out += chain_block(robot, chain, folder);
  out += '\n';
  if (robot.eigengrasps)
    fmt::format_to(to, "EigenGrasps\n{}\n", folder.eigengrasps(*robot.eigengrasps));
  if (robot.virtual_contacts)
    fmt::format_to(to, "VirtualContacts\n{}\n", folder.virtual_contacts(*robot.virtual_contacts));
  if (robot.glove) fmt::format_to(to, "CyberGlove\n{}\n", folder.glove(*robot.glove));
  if (robot.tracker)
    fmt::format_to(to, "FlockOfBirds\n{}\nT {}\n", robot.tracker->number,
                   full_transform(robot.tracker->X_BS));
  if (robot.X_BA) {
    const Eigen::Vector3d z = robot.X_BA->rotation * Eigen::Vector3d::UnitZ();
    fmt::format_to(to, "Approach\n{}\n{} {} {}\n", millimetres(robot.X_BA->position), z.x() + 0.0,
                   z.y() + 0.0, z.z() + 0.0);
  }
  return out;
}

}  // namespace clench
