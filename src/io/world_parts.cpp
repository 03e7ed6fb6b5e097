#include "io/world_parts.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "io/number_reader.h"

namespace clench {

namespace {

struct JointPlace {
  size_t chain, joint;
};

/// Joints of a DOF, in the order in which worlds count them.
std::vector<JointPlace> joints_of(const RobotSpec& robot, int dof) {
  std::vector<JointPlace> out;
  for (size_t c = 0; c < robot.chains.size(); ++c)
    for (size_t j = 0; j < robot.chains[c].joints.size(); ++j)
      if (robot.chains[c].joints[j].dof == dof) out.push_back({c, j});
  return out;
}

const JointSpec& joint_at(const RobotSpec& robot, const JointPlace& at) {
  return robot.chains[at.chain].joints[at.joint];
}

/// A DOF counts in the unit of its first joint: rad or mm.
double unit_of(const RobotSpec& robot, int dof) {
  return dof_slides(robot, dof) ? units::millimetre : 1.0;
}

}  // namespace

// --- DOFs ---

bool dof_slides(const RobotSpec& robot, int dof) {
  const auto joints = joints_of(robot, dof);
  return !joints.empty() && joint_at(robot, joints.front()).kind == JointKind::prismatic;
}

void read_dof_values(const Line& line, PlacedRobot& placed, const Listeners& listeners) {
  const RobotSpec& robot = placed.robot;
  const int dofs = static_cast<int>(robot.dofs.size());
  const bool plain = line.size() == dofs;
  // one more a joint that may have broken away
  int least = dofs;
  for (const auto& chain : robot.chains)
    for (const auto& joint : chain.joints)
      least += robot.dofs[joint.dof].kind == DofKind::breakaway;
  const auto repair = [&](int expected, const char* made) {
    tell(listeners.repair, listeners.warn,
         fmt::format("{}: expected {} numbers for the {} DOFs of {}, got {}; {}", line.place(),
                     expected, dofs, robot.name, line.size(), made));
  };
  // with joints that may break away nobody knows which numbers lack
  const bool short_line = line.size() < dofs && least == dofs;
  if (!plain && !short_line && line.size() < least)
    line.fail("expected {} numbers for the {} DOFs of {}, got {}", least, dofs, robot.name,
              line.size());
  for (const auto& chain : robot.chains) placed.apart.emplace_back(chain.joints.size());
  int next = 0;
  for (int d = 0; d < dofs; ++d) {
    if (short_line && d >= line.size()) {
      placed.dofs.push_back(robot.dofs[d].default_value);
      continue;
    }
    const auto joints = joints_of(robot, d);
    const double unit = unit_of(robot, d);
    placed.dofs.push_back(line.number(next++, fmt::format("DOF {} of {}", d, dofs)) * unit);
    if (robot.dofs[d].kind != DofKind::breakaway || plain) continue;
    for (const JointPlace& at : joints) {
      const std::string what = fmt::format("DOF {}: joint {} of chain {}", d, at.joint, at.chain);
      if (line.integer(next++, what + ": broken away (0 or 1)", 0, 1) == 0) continue;
      // written as the value of the DOF at which the joint stopped
      placed.apart[at.chain][at.joint] =
          line.number(next++, what) * unit * joint_at(robot, at).ratio;
    }
  }
  if (short_line) repair(dofs, "the others start at their defaults");
  if (next < line.size()) repair(next, "what follows is not used");
}

std::string dof_values(const PlacedRobot& placed) {
  const RobotSpec& robot = placed.robot;
  std::string out;
  const auto add = [&](const std::string& word) { out += (out.empty() ? "" : " ") + word; };
  for (size_t d = 0; d < robot.dofs.size(); ++d) {
    const auto joints = joints_of(robot, static_cast<int>(d));
    const double unit = unit_of(robot, static_cast<int>(d));
    const double value = d < placed.dofs.size() ? placed.dofs[d] : robot.dofs[d].default_value;
    add(number_in(value, unit));
    if (robot.dofs[d].kind != DofKind::breakaway) continue;
    for (const JointPlace& at : joints) {
      const Apart broken = placed.apart.empty() ? Apart() : placed.apart[at.chain][at.joint];
      add(broken ? "1 " + number_in(*broken, unit, joint_at(robot, at).ratio) : "0");
    }
  }
  return out;
}

// --- connections, cameras ---

void check_connections(const WorldSpec& world, const std::vector<std::string>& places) {
  const int robots = static_cast<int>(world.robots.size());
  std::vector<int> carrier(robots, -1);
  for (size_t i = 0; i < world.connections.size(); ++i) {
    const Connection& c = world.connections[i];
    const std::string& place = places[i];
    for (const auto& [who, index] : {std::pair("parent", c.parent), {"child", c.child}})
      if (index >= robots)
        fail("{}: {} robot: expected {}, got {}", place, who,
             robots ? fmt::format("one of the file's {} robots, from 0", robots)
                    : "a robot of the file, which has none",
             index);
    if (c.parent == c.child)
      fail("{}: child robot: expected another robot than the parent, got {}", place, c.child);
    const auto& chains = world.robots[c.parent].robot.chains;
    if (c.chain >= static_cast<int>(chains.size()))
      fail("{}: parent chain: expected one of {} chains of {}, got {}", place, chains.size(),
           world.robots[c.parent].robot.name, c.chain);
    if (chains[c.chain].links.empty())
      fail("{}: parent chain: chain {} has no link to carry a robot", place, c.chain);
    if (carrier[c.child] >= 0) fail("{}: child robot: robot {} is carried already", place, c.child);
    for (int robot = c.parent; robot >= 0; robot = carrier[robot])
      if (robot == c.child)
        fail("{}: child robot: expected one that does not carry robot {} already, got {}", place,
             c.parent, c.child);
    carrier[c.child] = c.parent;
  }
}

std::optional<Eigen::Quaterniond> camera_orientation(double x, double y, double z, double w) {
  return made_unit(Eigen::Vector4d(w, x, y, z));
}

std::optional<Camera> checked_camera(const Camera& camera, const std::string& place,
                                     const ReadOptions& options) {
  try {
    check_camera(camera, place + ": camera");
    return camera;
  } catch (const Error& error) {
    options.repaired(fmt::format("{}; the camera is not used", error.what()));
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

std::string millimetres(const Eigen::Vector3d& p) {
  return fmt::format("{} {} {}", number_in(p.x(), units::millimetre),
                     number_in(p.y(), units::millimetre), number_in(p.z(), units::millimetre));
}

std::string orientation(const Eigen::Quaterniond& q) {
  return fmt::format("{} {} {} {}", q.x(), q.y(), q.z(), q.w());
}

std::string full_transform(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format("({} {} {} {})[{}]", q.w(), q.x(), q.y(), q.z(), millimetres(pose.position));
}

std::string transform_element(const Pose& pose) {
  return "    <transform>\n      <fullTransform>" + full_transform(pose) +
         "</fullTransform>\n    </transform>\n";
}

}  // namespace clench
