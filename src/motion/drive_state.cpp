#include "clench/motion/drive_state.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "clench/base/watched.h"

namespace clench {

// a joint this near the position given by its DOF follows it again: rounding [rad or m]
static constexpr double in_place = 1e-12;

namespace {

// has the DOF returned to the position of a joint that it had left behind?
bool back_at(const DrivenRobot& driven, const Eigen::VectorXd& dofs, const JointSpec& joint,
             double own) {
  const double beyond = joint.ratio * dofs[joint.dof] - own;
  if (driven.sprung(joint.dof)) return std::abs(beyond) <= in_place;
  return beyond * (joint.ratio < 0 ? -1 : 1) <= 0;
}

// upper bound on the distance from the frame before a joint to the one after it, for any q
double span_of(const JointSpec& joint) {
  const double slides =
      joint.kind == JointKind::prismatic ? std::max(std::abs(joint.min), std::abs(joint.max)) : 0;
  return joint.X_PJ.position.norm() + slides;
}

// upper bound on the distance of any point of the body from the axis of a joint that moves it, for
// all joint positions on the path: lengths along the links, then the body's own extent
double lever(const DrivenRobot& driven, int joint, Id<Body> id) {
  const Robot& robot = driven.robot();
  const Body& body = driven.world.body(id);
  int link = driven.bodies.link(id);
  // a carried robot is rigid on its link
  const Pose X_WL = driven.world.pose(robot.links[link].body);
  const Eigen::Vector3d center = X_WL.inverse() * (driven.world.pose(id) * body.shape->center());
  double length = center.norm() + body.shape->radius();
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

// upper bound on the relative speed of two bodies: sum over the joints that move only one of them
double pair_speed(const DrivenRobot& driven, const JointSpeeds& speeds, Id<Body> a, Id<Body> b) {
  check_stop();
  double sum = 0;
  for (int j = 0; j < static_cast<int>(speeds.size()); ++j) {
    if (speeds[j] == 0) continue;
    const bool moves_a = driven.bodies.moved_by(j, a);
    if (moves_a == driven.bodies.moved_by(j, b)) continue;
    const bool turns = driven.robot().joints[j].kind == JointKind::revolute;
    sum += std::abs(speeds[j]) * (turns ? lever(driven, j, moves_a ? a : b) : 1);
  }
  return sum;
}

}  // namespace

std::vector<Contact> DrivenRobot::touching() const {
  return contacts(world, world.bodies(), bodies.movable(), &world.context());
}

PairBounds pairs_to_watch(const DrivenRobot& driven) {
  PairBounds pairs;
  std::set<Id<Body>> done;
  for (const auto a : driven.bodies.movable()) {
    done.insert(a);
    for (const auto b : driven.world.bodies())
      if (!done.contains(b) && driven.world.may_collide(a, b)) pairs.push_back({.a = a, .b = b});
  }
  return pairs;
}

JointSpeeds joint_speeds(const DrivenRobot& driven, const std::vector<JointPosition>& own,
                         const Eigen::VectorXd& rates, bool pulled) {
  JointSpeeds speeds;
  for (size_t j = 0; j < own.size(); ++j) {
    const Joint& joint = driven.robot().joints[j];
    const bool moves = !own[j] || (pulled && driven.sprung(joint.dof));
    speeds.push_back(moves ? joint.ratio * rates[joint.dof] : 0);
  }
  return speeds;
}

DrivePosture re_engaged(const DrivenRobot& driven, DrivePosture posture) {
  for (size_t j = 0; j < posture.own.size(); ++j)
    if (JointPosition& own = posture.own[j];
        own && back_at(driven, posture.dofs, driven.robot().joints[j], *own))
      own.reset();
  return posture;
}

Advance follow_path(const DrivenRobot& driven, PairBounds& pairs, const JointSpeeds& speeds,
                    double length, const std::function<void(double)>& place, int& queries) {
  for (PairBound& pair : pairs) pair.speed = pair_speed(driven, speeds, pair.a, pair.b);
  // pairs at rest keep their bounds
  const auto moves = std::partition(pairs.begin(), pairs.end(),
                                    [](const PairBound& pair) { return pair.speed > 0; });
  PairBounds watches(pairs.begin(), moves);
  const Advance end = advance(driven.world, watches, length, place, queries);
  std::copy(watches.begin(), watches.end(), pairs.begin());
  return end;
}

}  // namespace clench
