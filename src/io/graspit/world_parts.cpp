#include "clench/io/graspit/world_parts.h"

#include <algorithm>
#include <cmath>

#include "clench/base/units.h"
#include "clench/io/text/number_reader.h"
#include "clench/spec/chains.h"

namespace clench {

namespace {

/// Unit of a DOF, that of its first joint: rad or mm.
double unit_of(const RobotSpec& robot, int dof) {
  return dof_slides(robot, dof) ? units::millimeter : 1.0;
}

}  // namespace

// --- DOFs ---

void read_dof_values(const Line& line, PlacedRobot& placed, const Diagnostics& diagnostics) {
  const RobotSpec& robot = placed.robot;
  const int dofs = static_cast<int>(robot.dofs.size());
  const bool plain = line.size() == dofs;
  // one additional number per joint that may have broken away
  int least = dofs;
  each_joint(robot, [&](const JointSpec& joint) {
    least += robot.dofs[joint.dof].kind == DofKind::breakaway;
  });
  const auto repair = [&](int expected, const char* made) {
    diagnostics.repaired(line.place(), "expected {} numbers for the {} DOFs of {}, got {}; {}",
                         expected, dofs, robot.name, line.size(), made);
  };
  // with breakaway joints it is ambiguous which numbers are missing
  const bool short_line = line.size() < dofs && least == dofs;
  if (!plain && !short_line && line.size() < least)
    line.fail("expected {} numbers for the {} DOFs of {}, got {}", least, dofs, robot.name,
              line.size());
  const auto joints = joints_of(robot);
  placed.joint_positions.resize(joints.size());
  int next = 0;
  for (int d = 0; d < dofs; ++d) {
    if (short_line && d >= line.size()) {
      placed.dofs.push_back(robot.dofs[d].default_value);
      continue;
    }
    const double unit = unit_of(robot, d);
    placed.dofs.push_back(line.number(next++, fmt::format("DOF {} of {}", d, dofs)) * unit);
    if (robot.dofs[d].kind != DofKind::breakaway || plain) continue;
    for (size_t j = 0; j < joints.size(); ++j) {
      const auto& [chain, number, joint] = joints[j];
      if (joint->dof != d) continue;
      const std::string what = fmt::format("DOF {}: joint {} of chain {}", d, number, chain);
      if (line.integer(next++, what + ": broken away (0 or 1)", 0, 1) == 0) continue;
      // written as the value of the DOF at which the joint stopped
      placed.joint_positions[j] = line.number(next++, what) * unit * joint->ratio;
    }
  }
  if (short_line) repair(dofs, "the others start at their defaults");
  if (next < line.size()) repair(next, "what follows is not used");
}

std::string dof_values(const PlacedRobot& placed) {
  const RobotSpec& robot = placed.robot;
  const auto joints = joints_of(robot);
  std::string out;
  const auto add = [&](const std::string& word) { out += (out.empty() ? "" : " ") + word; };
  for (size_t d = 0; d < robot.dofs.size(); ++d) {
    const double unit = unit_of(robot, static_cast<int>(d));
    const double value = d < placed.dofs.size() ? placed.dofs[d] : robot.dofs[d].default_value;
    add(number_in(value, unit));
    if (robot.dofs[d].kind != DofKind::breakaway) continue;
    for (size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].joint->dof != static_cast<int>(d)) continue;
      const JointPosition broken =
          placed.joint_positions.empty() ? JointPosition() : placed.joint_positions[j];
      add(broken ? "1 " + number_in(*broken, unit, joints[j].joint->ratio) : "0");
    }
  }
  return out;
}

// --- connections, cameras ---

void find_connections(WorldSpec& world, const std::vector<ConnectionPlace>& places) {
  const int robots = static_cast<int>(world.robots.size());
  std::vector<int> parent_of(robots, -1);
  for (size_t i = 0; i < world.connections.size(); ++i) {
    Connection& c = world.connections[i];
    const auto& [place, chain] = places[i];
    for (const auto& [who, index] : {std::pair("parent", c.parent), {"child", c.child}})
      if (index >= robots)
        fail("{}: {} robot: expected {}, got {}", place, who,
             robots ? fmt::format("one of the file's {} robots, from 0", robots)
                    : "a robot of the file, which has none",
             index);
    if (c.parent == c.child)
      fail("{}: child robot: expected another robot than the parent, got {}", place, c.child);
    const RobotSpec& parent = world.robots[c.parent].robot;
    const auto chains = chains_of(parent);
    if (chain >= static_cast<int>(chains.size()))
      fail("{}: parent chain: expected one of {} chains of {}, got {}", place, chains.size(),
           parent.name, chain);
    c.link = chains[chain].links.back();
    if (parent_of[c.child] >= 0)
      fail("{}: child robot: robot {} is carried already", place, c.child);
    for (int robot = c.parent; robot >= 0; robot = parent_of[robot])
      if (robot == c.child)
        fail("{}: child robot: expected one that does not carry robot {} already, got {}", place,
             c.parent, c.child);
    parent_of[c.child] = c.parent;
  }
}

int chain_of(const WorldSpec& world, const Connection& connection) {
  const RobotSpec& parent = world.robots[connection.parent].robot;
  if (const auto chain = chain_ending_at(parent, connection.link)) return *chain;
  fail(
      "{}: '{}' is carried by '{}', which is not the last link of a chain; the format has no other "
      "connections",
      world.source.empty() ? "the world" : excerpt(world.source),
      excerpt(world.robots[connection.child].robot.name),
      excerpt(parent.links[connection.link].body.name));
}

std::optional<Eigen::Quaterniond> camera_orientation(const Eigen::Vector4d& xyzw,
                                                     const Place& subject,
                                                     const ReadOptions& options) {
  const auto q = made_unit({xyzw[3], xyzw[0], xyzw[1], xyzw[2]});
  if (!q)
    options.diagnostics.repaired(
        subject, "expected a quaternion of length 1, got {} {} {} {}; the camera is not used",
        xyzw[0], xyzw[1], xyzw[2], xyzw[3]);
  return q;
}

std::optional<Camera> checked_camera(const Camera& camera, const Place& place,
                                     const ReadOptions& options) {
  try {
    check_camera(camera, "camera");
    return camera;
  } catch (const Error& error) {
    options.diagnostics.repaired(place, "{}; the camera is not used", error.what());
    return {};
  }
}

// --- numbers as texts ---

std::string number_in(double value, double unit, double factor) {
  const auto read = [&](double written) { return written * unit * factor; };
  double best = value / (unit * factor);
  if (!std::isfinite(best)) return fmt::format("{}", value);
  std::string shortest;
  double low = best, high = best;
  for (int i = 0; i < 4; ++i) {
    for (const double written : {low, high}) {
      const std::string text = fmt::format("{}", written);
      if (read(written) == value && (shortest.empty() || text.size() < shortest.size()))
        shortest = text;
      if (std::abs(read(written) - value) < std::abs(read(best) - value)) best = written;
    }
    low = std::nextafter(low, -HUGE_VAL);
    high = std::nextafter(high, HUGE_VAL);
  }
  return shortest.empty() ? fmt::format("{}", best) : shortest;
}

std::string millimeters(const Eigen::Vector3d& p) {
  return fmt::format("{} {} {}", number_in(p.x(), units::millimeter),
                     number_in(p.y(), units::millimeter), number_in(p.z(), units::millimeter));
}

std::string orientation(const Eigen::Quaterniond& q) {
  return fmt::format("{} {} {} {}", q.x(), q.y(), q.z(), q.w());
}

std::string full_transform(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format("({} {} {} {})[{}]", q.w(), q.x(), q.y(), q.z(), millimeters(pose.position));
}

std::string transform_element(const Pose& pose) {
  return "    <transform>\n      <fullTransform>" + full_transform(pose) +
         "</fullTransform>\n    </transform>\n";
}

}  // namespace clench
