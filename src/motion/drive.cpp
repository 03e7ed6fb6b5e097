#include "motion/drive.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "motion/advance.h"
#include "motion/blocked_joints.h"
#include "motion/move.h"

namespace clench {

// a DOF this near its target is there: rounding of a path's length [rad or m]
static constexpr double arrived = 1e-13;
// changes below this are no motion [rad or m]
static constexpr double no_motion = 1e-5;
// fingers that slide along a surface stop and go; one that has not come to rest after so many contacts is stopped
static constexpr int most_events = 2000;

namespace {

using JointSpeeds = std::vector<std::vector<double>>;

// a robot on its way: what a drive changes from contact to contact
struct Drive {
  World& world;
  Id<Robot> id;
  Eigen::VectorXd targets;
  std::vector<Id<Body>> moving;
  Eigen::VectorXd q;
  std::vector<std::vector<Breakaway>> breakaway;
  std::vector<Watch> pairs;

  const Robot& robot() const { return world.robot(id); }
  void place() { world.set_dofs_unchecked(id, q, breakaway); }
};

JointSpeeds joint_speeds(const Drive& drive, const Eigen::VectorXd& rates) {
  JointSpeeds speeds;
  for (size_t c = 0; c < drive.breakaway.size(); ++c) {
    const auto& joints = drive.robot().chains[c].joints;
    speeds.emplace_back();
    for (size_t j = 0; j < joints.size(); ++j)
      speeds[c].push_back(drive.breakaway[c][j] ? 0 : joints[j].ratio * rates[joints[j].dof]);
  }
  return speeds;
}

// visits chain, joint and its spec for all joints of a DOF
template <class Visit>
void each_joint(const Robot& robot, int dof, Visit visit) {
  for (int c = 0; c < static_cast<int>(robot.chains.size()); ++c)
    for (int j = 0; j < static_cast<int>(robot.chains[c].joints.size()); ++j)
      if (robot.chains[c].joints[j].dof == dof) visit(c, j, robot.chains[c].joints[j]);
}

// has the DOF gone back to where a joint broke away from it?
bool back_at(const JointSpec& joint, double q, double broken_at) {
  return (joint.ratio * q - broken_at) * (joint.ratio < 0 ? -1 : 1) <= 0;
}

void re_engage(Drive& drive) {
  for (int dof = 0; dof < drive.q.size(); ++dof)
    each_joint(drive.robot(), dof, [&](int c, int j, const JointSpec& joint) {
      Breakaway& broken = drive.breakaway[c][j];
      if (broken && back_at(joint, drive.q[dof], *broken)) broken.reset();
    });
}

// may the DOF go on past its blocked joints? a breakaway DOF, closing, leaves them behind
bool goes_on(Drive& drive, int dof, double rate, const BlockedJoints& blocked) {
  int stopped = 0, free = 0;
  each_joint(drive.robot(), dof, [&](int c, int j, const JointSpec&) {
    if (blocked.joints.contains({c, j}))
      ++stopped;
    else if (!drive.breakaway[c][j])
      ++free;
  });
  if (stopped == 0) return free > 0;
  if (drive.robot().dofs[dof].kind != DofKind::breakaway || rate < 0 || free == 0) return false;
  each_joint(drive.robot(), dof, [&](int c, int j, const JointSpec& joint) {
    if (blocked.joints.contains({c, j})) drive.breakaway[c][j] = joint.ratio * drive.q[dof];
  });
  return true;
}

// Stops the DOFs that contacts block; what one of them held apart may block others.
// returns  the pairs whose contacts do
std::vector<BodyPair> stop_blocked(Drive& drive, Eigen::VectorXd& rates, double closed,
                                   std::vector<DofStop>& stops) {
  const auto touching = contacts(drive.world, drive.world.bodies(), drive.moving);
  std::vector<BodyPair> pairs;
  for (bool changed = true; changed;) {
    changed = false;
    const auto left_behind = drive.breakaway;
    const auto blocked =
        blocked_joints(drive.world, drive.id, joint_speeds(drive, rates), touching, closed);
    for (int i = 0; i < rates.size(); ++i)
      if (rates[i] != 0 && !goes_on(drive, i, rates[i], blocked)) {
        rates[i] = 0;
        stops[i] = DofStop::contact;
        changed = true;
      }
    changed = changed || left_behind != drive.breakaway;
    for (const BodyPair& pair : blocked.pairs)
      if (std::ranges::find(pairs, pair) == pairs.end()) pairs.push_back(pair);
  }
  return pairs;
}

// how far the path runs before a DOF arrives or, opening, picks up a joint that it had left behind
double path_length(const Drive& drive, const Eigen::VectorXd& rates) {
  double length = std::numeric_limits<double>::infinity();
  for (int dof = 0; dof < rates.size(); ++dof) {
    if (rates[dof] == 0) continue;
    length = std::min(length, (drive.targets[dof] - drive.q[dof]) / rates[dof]);
    each_joint(drive.robot(), dof, [&](int c, int j, const JointSpec& joint) {
      if (!drive.breakaway[c][j]) return;
      const double there = (*drive.breakaway[c][j] / joint.ratio - drive.q[dof]) / rates[dof];
      if (there > 0) length = std::min(length, there);
    });
  }
  return length;
}

// bound of the way that a joint's frames span, whatever its q
double span_of(const JointSpec& joint) {
  const double d = joint.kind == JointKind::prismatic
                       ? std::max(std::abs(joint.d + joint.min), std::abs(joint.d + joint.max))
                       : std::abs(joint.d);
  return std::hypot(joint.a, d) +
         (joint.placed_freely ? joint.X_before.position.norm() + joint.X_after.position.norm() : 0);
}

// bound of the distance of any point of the body from the axis of a joint that moves it, whatever the joints do
// on the way: lengths along the chains, then the body's own extent
double lever(const Drive& drive, JointPlace joint, Id<Body> id) {
  const Robot& robot = drive.robot();
  const Body& body = drive.world.body(id);
  auto [chain, link] = carrying_link(drive.world, drive.id, id);
  // a carried robot is rigid on its link
  const Pose X_WL = drive.world.body(robot.chains[chain].links[link]).X_WB;
  const Eigen::Vector3d centre = X_WL.inverse() * (body.X_WB * body.shape->centre());
  double length = centre.norm() + body.shape->radius();
  while (true) {
    const Chain& c = robot.chains[chain];
    const bool here = chain == joint.first;
    if (c.X_JL[link]) length += c.X_JL[link]->position.norm();
    for (int k = here ? joint.second : 0; k <= c.last_joints[link]; ++k)
      length += span_of(c.joints[k]);
    if (here) return length;
    length += c.X_BC.position.norm();
    chain = c.parent_chain;
    link = c.parent_link;
  }
}

// bound of the relative speed of two bodies: the joints that move one of them and not the other
double pair_speed(const Drive& drive, const JointSpeeds& speeds, Id<Body> a, Id<Body> b) {
  double sum = 0;
  for (int c = 0; c < static_cast<int>(speeds.size()); ++c)
    for (int j = 0; j < static_cast<int>(speeds[c].size()); ++j) {
      if (speeds[c][j] == 0) continue;
      const bool moves_a = joint_moves(drive.world, drive.id, {c, j}, a);
      if (moves_a == joint_moves(drive.world, drive.id, {c, j}, b)) continue;
      const bool turns = drive.robot().chains[c].joints[j].kind == JointKind::revolute;
      sum += std::abs(speeds[c][j]) * (turns ? lever(drive, {c, j}, moves_a ? a : b) : 1);
    }
  return sum;
}

// pairs that some joint can bring together, nothing known of them yet
std::vector<Watch> all_pairs(const Drive& drive) {
  std::vector<Watch> pairs;
  std::set<Id<Body>> done;
  for (const auto a : drive.moving) {
    done.insert(a);
    for (const auto b : drive.world.bodies())
      if (!done.contains(b) && drive.world.may_collide(a, b)) pairs.push_back({.a = a, .b = b});
  }
  return pairs;
}

// follows the path until a DOF arrives or a pair touches
Advance follow(Drive& drive, const Eigen::VectorXd& rates, int& queries) {
  const double length = path_length(drive, rates);
  const JointSpeeds speeds = joint_speeds(drive, rates);
  for (Watch& pair : drive.pairs) pair.speed = pair_speed(drive, speeds, pair.a, pair.b);
  // what rests keeps what is known of it
  const auto moves = std::partition(drive.pairs.begin(), drive.pairs.end(),
                                    [](const Watch& pair) { return pair.speed > 0; });
  std::vector<Watch> watches(drive.pairs.begin(), moves);
  const Eigen::VectorXd start = drive.q;
  const auto place = [&](double s) {
    drive.q = start + s * rates;
    // who arrives, arrives exactly
    for (int i = 0; i < rates.size(); ++i)
      if (rates[i] != 0 && std::abs(drive.targets[i] - drive.q[i]) <= arrived)
        drive.q[i] = drive.targets[i];
    drive.place();
  };
  const Advance end = advance(drive.world, watches, length, place, queries);
  std::copy(watches.begin(), watches.end(), drive.pairs.begin());
  return end;
}

void check(const Robot& robot, const DofMotion& motion) {
  if (motion.targets.size() != robot.q.size())
    fail("driving '{}': wanted {} DOF values, got {}", robot.name, robot.q.size(),
         motion.targets.size());
  if (motion.rates.size() != motion.targets.size())
    fail("driving '{}': wanted {} paces, got {}", robot.name, motion.targets.size(),
         motion.rates.size());
  for (int i = 0; i < motion.targets.size(); ++i) {
    const auto [low, high] = robot.limits[i];
    // a limit that went through degrees and back is still the limit
    const double slack = 1e-9 * std::max({1.0, std::abs(low), std::abs(high)});
    if (!(motion.targets[i] >= low - slack && motion.targets[i] <= high + slack))
      fail("driving '{}': DOF {} must lie in [{}, {}], got {}", robot.name, i + 1, low, high,
           motion.targets[i]);
    if (!std::isfinite(motion.rates[i]))
      fail("driving '{}': the pace of DOF {} must be finite, got {}", robot.name, i + 1,
           motion.rates[i]);
  }
}

void give_up(DriveResult& result, const Eigen::VectorXd& rates) {
  for (int i = 0; i < rates.size(); ++i)
    if (rates[i] != 0) result.stops[i] = DofStop::gave_up;
}

}  // namespace

DriveResult drive(World& world, Id<Robot> id, const DofMotion& motion,
                  const DriveOptions& options) {
  const Robot& robot = world.robot(id);
  check(robot, motion);
  Drive drive{world, id, motion.targets, movable_bodies(world, id), robot.q, {}, {}};
  for (size_t i = 0; i < robot.limits.size(); ++i)
    drive.targets[i] = std::clamp(drive.targets[i], robot.limits[i][0], robot.limits[i][1]);
  for (const auto& chain : robot.chains) drive.breakaway.push_back(chain.breakaway);
  drive.pairs = all_pairs(drive);
  refuse_collision(world, drive.moving, fmt::format("driving '{}'", robot.name));

  // the path does not depend on the pace: the fastest DOF counts as 1
  const double fastest = motion.rates.lpNorm<Eigen::Infinity>();
  const double pace = fastest > 0 ? fastest : 1;
  const Eigen::VectorXd start = robot.q;
  DriveResult result;
  result.stops.assign(robot.dofs.size(), DofStop::still);
  while (true) {
    // who has somewhere to go, and is not blocked
    re_engage(drive);
    Eigen::VectorXd rates = motion.rates / pace;
    for (int i = 0; i < rates.size(); ++i) {
      const double way = drive.targets[i] - drive.q[i];
      if (rates[i] * way > 0) continue;
      if (rates[i] != 0) {
        const auto [low, high] = robot.limits[i];
        result.stops[i] =
            drive.q[i] == low || drive.q[i] == high ? DofStop::limit : DofStop::reached;
      }
      rates[i] = 0;
    }
    const double closed = 2 * nearly_closed * world.contact_threshold();
    result.stopped_by = stop_blocked(drive, rates, closed, result.stops);
    if (rates.isZero(0)) break;
    if (result.events >= most_events) {
      give_up(result, rates);
      break;
    }

    const Advance end = follow(drive, rates, result.queries);
    if (end.gave_up) give_up(result, rates);
    if (end.gave_up) break;
    if (!end.stopped_by) continue;
    ++result.events;
    if (options.stop_at_contact && !end.stopped_by->touching) {
      result.stopped_by = {{end.stopped_by->a, end.stopped_by->b}};
      for (int i = 0; i < rates.size(); ++i)
        if (rates[i] != 0) result.stops[i] = DofStop::contact;
      break;
    }
  }
  drive.place();
  result.moved = (drive.q - start).lpNorm<Eigen::Infinity>() > no_motion;
  return result;
}

DriveResult drive_to(World& world, Id<Robot> id, const Eigen::VectorXd& targets,
                     const DriveOptions& options) {
  const Robot& robot = world.robot(id);
  if (targets.size() != robot.q.size())
    fail("driving '{}': wanted {} DOF values, got {}", robot.name, robot.q.size(), targets.size());
  return drive(world, id, {.targets = targets, .rates = targets - robot.q}, options);
}

}  // namespace clench
