#include "clench/motion/drive_state.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"

namespace clench {

// a joint this near its place in the DOF follows it again: rounding [rad or m]
static constexpr double in_place = 1e-12;

namespace {

// has the DOF come to where a joint stands that left it?
bool back_at(const Drive& drive, const JointSpec& joint, double own) {
  const double beyond = joint.ratio * drive.q[joint.dof] - own;
  if (drive.sprung(joint.dof)) return std::abs(beyond) <= in_place;
  return beyond * (joint.ratio < 0 ? -1 : 1) <= 0;
}

// bound of the way from the frame before a joint to the one behind it, whatever its q
double span_of(const JointSpec& joint) {
  const double slides =
      joint.kind == JointKind::prismatic ? std::max(std::abs(joint.min), std::abs(joint.max)) : 0;
  return joint.X_PJ.position.norm() + slides;
}

// bound of the distance of any point of the body from the axis of a joint that moves it, whatever
// the joints do on the way: lengths along the links, then the body's own extent
double lever(const Drive& drive, int joint, Id<Body> id) {
  const Robot& robot = drive.robot();
  const Body& body = drive.world.body(id);
  int link = carrying_link(drive.world, drive.id, id);
  // a carried robot is rigid on its link
  const Pose X_WL = drive.world.pose(robot.links[link].body);
  const Eigen::Vector3d centre = X_WL.inverse() * (drive.world.pose(id) * body.shape->centre());
  double length = centre.norm() + body.shape->radius();
  while (true) {
    const Link& l = robot.links[link];
    const bool here = link == robot.joints[joint].link;
    length += l.X_JL.position.norm();
    for (int k = here ? joint + 1 : l.first_joint; k < l.end_joint; ++k)
      length += span_of(robot.joints[k]);
    if (here) return length;
    link = l.parent;
  }
}

// bound of the relative speed of two bodies: the joints that move one of them and not the other
double pair_speed(const Drive& drive, const JointSpeeds& speeds, Id<Body> a, Id<Body> b) {
  check_stop();
  double sum = 0;
  for (int j = 0; j < static_cast<int>(speeds.size()); ++j) {
    if (speeds[j] == 0) continue;
    const bool moves_a = joint_moves(drive.world, drive.id, j, a);
    if (moves_a == joint_moves(drive.world, drive.id, j, b)) continue;
    const bool turns = drive.robot().joints[j].kind == JointKind::revolute;
    sum += std::abs(speeds[j]) * (turns ? lever(drive, j, moves_a ? a : b) : 1);
  }
  return sum;
}

// pairs that some joint can bring together, nothing known of them yet
std::vector<PairBound> all_pairs(const Drive& drive) {
  std::vector<PairBound> pairs;
  std::set<Id<Body>> done;
  for (const auto a : drive.moving) {
    done.insert(a);
    for (const auto b : drive.world.bodies())
      if (!done.contains(b) && drive.world.may_collide(a, b)) pairs.push_back({.a = a, .b = b});
  }
  return pairs;
}

}  // namespace

Drive begin_drive(World& world, Id<Robot> id) {
  Drive drive{world, id, movable_bodies(world, id), world.dofs(id), world.own_joint_positions(id),
              {}};
  drive.pairs = all_pairs(drive);
  return drive;
}

JointSpeeds joint_speeds(const Drive& drive, const Eigen::VectorXd& rates, bool pulled) {
  JointSpeeds speeds;
  for (size_t j = 0; j < drive.joint_positions.size(); ++j) {
    const Joint& joint = drive.robot().joints[j];
    const bool moves = !drive.joint_positions[j] || (pulled && drive.sprung(joint.dof));
    speeds.push_back(moves ? joint.ratio * rates[joint.dof] : 0);
  }
  return speeds;
}

void re_engage(Drive& drive) {
  for (size_t j = 0; j < drive.joint_positions.size(); ++j)
    if (JointPosition& own = drive.joint_positions[j];
        own && back_at(drive, drive.robot().joints[j], *own))
      own.reset();
}

Advance follow_path(Drive& drive, const JointSpeeds& speeds, double length,
                    const std::function<void(double)>& place, int& queries) {
  for (PairBound& pair : drive.pairs) pair.speed = pair_speed(drive, speeds, pair.a, pair.b);
  // what rests keeps what is known of it
  const auto moves = std::partition(drive.pairs.begin(), drive.pairs.end(),
                                    [](const PairBound& pair) { return pair.speed > 0; });
  std::vector<PairBound> watches(drive.pairs.begin(), moves);
  const Advance end = advance(drive.world, watches, length, place, queries);
  std::copy(watches.begin(), watches.end(), drive.pairs.begin());
  return end;
}

}  // namespace clench
