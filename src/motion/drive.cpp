#include "clench/motion/drive.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/model/dof.h"
#include "clench/motion/move.h"
#include "clench/motion/relax_springs.h"
#include "clench/motion/springs.h"

namespace clench {

// a DOF this near its target is there: rounding of a path's length [rad or m]
static constexpr double arrived = 1e-13;
// changes below this are no motion [rad or m]
static constexpr double no_motion = 1e-5;
// fingers that slide along a surface stop and go; one that has not come to rest after so many
// contacts is stopped
static constexpr int max_events = 2000;
// once something holds a joint of a compliant DOF, its tendon is pulled in steps that would turn
// the joint by this, and its springs come to rest after each [rad or m]
static constexpr double pull_step = 0.02;
// at its end it waits for springs that creep on, so often
static constexpr int max_unrest = 20;

namespace {

// may a compliant DOF go on? it leaves blocked joints behind, and winds up their springs until
// contacts and limits would hold against whatever more it pulls
bool tendon_can_advance(Drive& drive, int dof, double rate, const BlockedJoints& blocked,
                        const SpringBalance& springs) {
  bool free = false, unwinds = false;
  each_joint_of(drive.robot(), dof, [&](int j, const Joint& joint) {
    JointPosition& own = drive.joint_positions[j];
    const double place = joint.ratio * drive.q[dof];
    if (!own && blocked.joints.contains(j))
      own = place;
    else if (!own)
      free = true;
    else
      unwinds = unwinds || (place - *own) * joint.ratio * rate < 0;
  });
  return free || unwinds || !springs.balanced_by_contacts(dof, rate < 0 ? -1 : 1);
}

// may the DOF go on past its blocked joints? a breakaway DOF, closing, leaves them behind
bool dof_can_advance(Drive& drive, int dof, double rate, const BlockedJoints& blocked) {
  int stopped = 0, free = 0;
  each_joint_of(drive.robot(), dof, [&](int j, const Joint&) {
    if (blocked.joints.contains(j))
      ++stopped;
    else if (!drive.joint_positions[j])
      ++free;
  });
  if (stopped == 0) return free > 0;
  if (drive.robot().dofs[dof].kind != DofKind::breakaway || rate < 0 || free == 0) return false;
  each_joint_of(drive.robot(), dof, [&](int j, const Joint& joint) {
    if (blocked.joints.contains(j)) drive.joint_positions[j] = joint.ratio * drive.q[dof];
  });
  return true;
}

// Stops the DOFs that contacts block; what one of them held apart may block others.
// returns  the pairs whose contacts do
std::vector<BodyPair> stop_blocked(Drive& drive, Eigen::VectorXd& rates, double closed,
                                   std::vector<DofStop>& stops) {
  const auto touching =
      contacts(drive.world, drive.world.bodies(), drive.moving, &drive.world.context());
  const SpringBalance springs(drive.world, drive.id, touching);
  std::vector<BodyPair> pairs;
  for (bool changed = true; changed;) {
    changed = false;
    const auto left_behind = drive.joint_positions;
    const auto blocked =
        blocked_joints(drive.world, drive.id, joint_speeds(drive, rates, true), touching, closed);
    for (int i = 0; i < rates.size(); ++i) {
      if (rates[i] == 0) continue;
      if (drive.sprung(i) ? tendon_can_advance(drive, i, rates[i], blocked, springs)
                          : dof_can_advance(drive, i, rates[i], blocked))
        continue;
      rates[i] = 0;
      stops[i] = DofStop::contact;
      changed = true;
    }
    changed = changed || left_behind != drive.joint_positions;
    for (const BodyPair& pair : blocked.pairs)
      if (std::ranges::find(pairs, pair) == pairs.end()) pairs.push_back(pair);
  }
  return pairs;
}

// how far the path runs before a DOF arrives, picks up a joint that it had left behind, or has
// deflected springs by a step
double path_length(const Drive& drive, const Eigen::VectorXd& rates) {
  double length = std::numeric_limits<double>::infinity();
  for (int dof = 0; dof < rates.size(); ++dof) {
    if (rates[dof] == 0) continue;
    length = std::min(length, (drive.targets[dof] - drive.q[dof]) / rates[dof]);
    each_joint_of(drive.robot(), dof, [&](int j, const Joint& joint) {
      if (!drive.joint_positions[j]) return;
      const double there = (*drive.joint_positions[j] / joint.ratio - drive.q[dof]) / rates[dof];
      if (there > 0) length = std::min(length, there);
      if (drive.sprung(dof))
        length = std::min(length, pull_step / std::abs(joint.ratio * rates[dof]));
    });
  }
  return length;
}

// follows the path until a DOF arrives or a pair touches
Advance follow(Drive& drive, const Eigen::VectorXd& rates, int& queries) {
  const Eigen::VectorXd start = drive.q;
  const auto place = [&](double s) {
    drive.q = start + s * rates;
    // who arrives, arrives exactly
    for (int i = 0; i < rates.size(); ++i)
      if (rates[i] != 0 && std::abs(drive.targets[i] - drive.q[i]) <= arrived)
        drive.q[i] = drive.targets[i];
    drive.place();
  };
  return follow_path(drive, joint_speeds(drive, rates), path_length(drive, rates), place, queries);
}

void check(const Robot& robot, const DofMotion& motion) {
  if (motion.targets.size() != static_cast<Eigen::Index>(robot.dofs.size()))
    fail("driving '{}': expected {} DOF values, got {}", excerpt(robot.name), robot.dofs.size(),
         motion.targets.size());
  if (motion.rates.size() != motion.targets.size())
    fail("driving '{}': expected {} paces, got {}", excerpt(robot.name), motion.targets.size(),
         motion.rates.size());
  for (int i = 0; i < motion.targets.size(); ++i) {
    within_limits(robot, i, motion.targets[i], "driving");
    if (!std::isfinite(motion.rates[i]))
      fail("driving '{}': the pace of DOF {} must be finite, got {}", excerpt(robot.name), i + 1,
           motion.rates[i]);
  }
}

bool any_moved(const Eigen::VectorXd& before, const Eigen::VectorXd& now) {
  return before.size() > 0 && (now - before).lpNorm<Eigen::Infinity>() > no_motion;
}

// all that were on their way
void stop_all(DriveResult& result, const Eigen::VectorXd& rates, DofStop why) {
  for (int i = 0; i < rates.size(); ++i)
    if (rates[i] != 0) result.stops[i] = why;
}

// of what was asked for, what has somewhere to go
void stop_arrived(const Drive& drive, Eigen::VectorXd& rates, DriveResult& result) {
  for (int i = 0; i < rates.size(); ++i) {
    const double way = drive.targets[i] - drive.q[i];
    if (rates[i] * way > 0) continue;
    if (rates[i] != 0) {
      const auto [low, high] = range_around(drive.robot(), i, drive.q[i]);
      result.stops[i] = drive.q[i] == low || drive.q[i] == high ? DofStop::limit : DofStop::reached;
    }
    rates[i] = 0;
  }
}

// Goes from event to event until nothing moves. `rates` are of the fastest DOF.
void drive_on(Drive& drive, const Eigen::VectorXd& all_rates, const DriveOptions& options,
              DriveResult& result) {
  const bool sprung = std::ranges::any_of(
      drive.robot().dofs, [](const DofSpec& dof) { return dof.kind == DofKind::compliant; });
  const double closed = 2 * nearly_closed * drive.world.contact_threshold();
  int unrest = 0;
  while (true) {
    drive.world.context().progress().check();
    check_stop();
    re_engage(drive);
    const Springs springs = sprung ? relax_springs(drive, options, result) : Springs::at_rest;
    if (springs == Springs::stopped) return stop_all(result, all_rates, DofStop::contact);
    // who has somewhere to go, and is not blocked
    Eigen::VectorXd rates = all_rates;
    stop_arrived(drive, rates, result);
    result.stopped_by = stop_blocked(drive, rates, closed, result.stops);
    if (rates.isZero(0)) {
      if (springs == Springs::at_rest) return;
      if (++unrest <= max_unrest) continue;
      for (int i = 0; i < rates.size(); ++i)
        if (drive.sprung(i)) result.stops[i] = DofStop::iteration_limit;
      return;
    }
    if (result.events >= max_events) return stop_all(result, rates, DofStop::iteration_limit);

    const Advance end = follow(drive, rates, result.queries);
    if (end.iteration_limit) return stop_all(result, rates, DofStop::iteration_limit);
    if (!end.stopped_by) continue;
    ++result.events;
    if (options.stop_at_contact && !end.stopped_by->touching) {
      result.stopped_by = {{end.stopped_by->a, end.stopped_by->b}};
      return stop_all(result, rates, DofStop::contact);
    }
  }
}

}  // namespace

DriveResult drive(World& world, Id<Robot> id, const DofMotion& motion,
                  const DriveOptions& options) {
  const Robot& robot = world.robot(id);
  check(robot, motion);
  Drive drive = begin_drive(world, id);
  drive.targets = motion.targets;
  for (int i = 0; i < drive.targets.size(); ++i) {
    const auto [low, high] = range_around(robot, i, drive.targets[i]);
    drive.targets[i] = std::clamp(drive.targets[i], low, high);
  }
  refuse_collision(world, drive.moving, fmt::format("driving '{}'", excerpt(robot.name)));

  // the path does not depend on the pace: the fastest DOF counts as 1
  const double fastest = motion.rates.lpNorm<Eigen::Infinity>();
  const double pace = fastest > 0 ? fastest : 1;
  const Eigen::VectorXd dofs = world.dofs(id), joints = world.joints(id);
  DriveResult result;
  result.stops.assign(robot.dofs.size(), DofStop::not_driven);
  drive_on(drive, motion.rates / pace, options, result);
  drive.place();
  result.moved = any_moved(dofs, world.dofs(id)) || any_moved(joints, world.joints(id));
  return result;
}

DriveResult drive_to(World& world, Id<Robot> id, const Eigen::VectorXd& targets,
                     const DriveOptions& options) {
  const Robot& robot = world.robot(id);
  if (targets.size() != static_cast<Eigen::Index>(robot.dofs.size()))
    fail("driving '{}': expected {} DOF values, got {}", excerpt(robot.name), robot.dofs.size(),
         targets.size());
  return drive(world, id, {.targets = targets, .rates = targets - world.dofs(id)}, options);
}

}  // namespace clench
