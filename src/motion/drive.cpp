#include "clench/motion/drive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/model/dof.h"
#include "clench/motion/move.h"
#include "clench/motion/relax_springs.h"
#include "clench/motion/springs.h"

namespace clench {

// a DOF this near its target has arrived: rounding of a path's length [rad or m]
static constexpr double arrived = 1e-13;
// smaller changes do not count as motion [rad or m]
static constexpr double no_motion = 1e-5;
// fingers that slide along a surface stop and start repeatedly; one that has not come to rest after
// this many contacts is stopped
static constexpr int max_events = 2000;
// when a joint of a compliant DOF is blocked, its tendon is pulled in steps that would turn the
// joint by this angle, and its springs come to rest after each [rad or m]
static constexpr double pull_step = 0.02;
// number of times that a blocked drive waits for springs that still creep
static constexpr int max_unrest = 20;

namespace {

/// Does a DOF advance past its blocked joints, and which of them does it leave behind?
struct Passing {
  bool advances = false;
  std::vector<int> left_behind = {};
};

// A compliant DOF leaves blocked joints behind, and deflects their springs until contacts and
// limits would balance any further pull.
Passing pass_with_springs(const Robot& robot, const DrivePosture& posture, int dof, double rate,
                          const BlockedJoints& blocked, const SpringBalance& springs) {
  Passing out;
  bool free = false, unwinds = false;
  each_joint_of(robot, dof, [&](int j, const Joint& joint) {
    const JointPosition& own = posture.own[j];
    const double place = joint.ratio * posture.dofs[dof];
    if (!own && blocked.joints.contains(j))
      out.left_behind.push_back(j);
    else if (!own)
      free = true;
    else
      unwinds = unwinds || (place - *own) * joint.ratio * rate < 0;
  });
  out.advances = free || unwinds || !springs.balanced_by_contacts(dof, rate < 0 ? -1 : 1);
  return out;
}

// A closing breakaway DOF leaves blocked joints behind; a rigid one stops with them.
Passing pass_rigidly(const Robot& robot, const DrivePosture& posture, int dof, double rate,
                     const BlockedJoints& blocked) {
  std::vector<int> stopped;
  int free = 0;
  each_joint_of(robot, dof, [&](int j, const Joint&) {
    if (blocked.joints.contains(j))
      stopped.push_back(j);
    else if (!posture.own[j])
      ++free;
  });
  if (stopped.empty()) return {.advances = free > 0};
  if (robot.dofs[dof].kind != DofKind::breakaway || rate < 0 || free == 0) return {};
  return {.advances = true, .left_behind = stopped};
}

/// Motion of the DOFs after contacts have stopped some of them.
struct BlockedDofs {
  DrivePosture posture;         ///< including the joints that are left behind
  Eigen::VectorXd rates;        ///< 0 for stopped DOFs
  std::vector<int> stopped;     ///< indices of the stopped DOFs
  std::vector<BodyPair> pairs;  ///< pairs whose contacts stop DOFs or block joints
};

// Stops the DOFs that contacts block; stopping one can cause contacts to block others.
BlockedDofs find_blocked(const DrivenRobot& driven, const DrivePosture& posture,
                         const Eigen::VectorXd& rates, std::span<const Contact> touching) {
  const double closed = 2 * nearly_closed * driven.world.contact_threshold();
  const SpringBalance springs(driven.world, driven.id, driven.bodies, touching);
  BlockedDofs out{posture, rates, {}, {}};
  for (bool changed = true; changed;) {
    changed = false;
    const auto speeds = joint_speeds(driven, out.posture.own, out.rates, true);
    const auto blocked =
        blocked_joints(driven.world, driven.id, driven.bodies, speeds, touching, closed);
    for (int i = 0; i < out.rates.size(); ++i) {
      const double rate = out.rates[i];
      if (rate == 0) continue;
      const Passing passing =
          driven.sprung(i)
              ? pass_with_springs(driven.robot(), out.posture, i, rate, blocked, springs)
              : pass_rigidly(driven.robot(), out.posture, i, rate, blocked);
      for (const int j : passing.left_behind)
        out.posture.own[j] = driven.robot().joints[j].ratio * out.posture.dofs[i];
      changed = changed || !passing.left_behind.empty() || !passing.advances;
      if (passing.advances) continue;
      out.rates[i] = 0;
      out.stopped.push_back(i);
    }
    for (const BodyPair& pair : blocked.pairs)
      if (std::ranges::find(out.pairs, pair) == out.pairs.end()) out.pairs.push_back(pair);
  }
  return out;
}

// path length until a DOF arrives, reaches a joint that it had left behind, or has deflected
// springs by a step
double path_length(const DrivenRobot& driven, const DrivePosture& posture,
                   const Eigen::VectorXd& targets, const Eigen::VectorXd& rates) {
  double length = std::numeric_limits<double>::infinity();
  for (int dof = 0; dof < rates.size(); ++dof) {
    if (rates[dof] == 0) continue;
    const double q = posture.dofs[dof];
    length = std::min(length, (targets[dof] - q) / rates[dof]);
    each_joint_of(driven.robot(), dof, [&](int j, const Joint& joint) {
      if (!posture.own[j]) return;
      const double there = (*posture.own[j] / joint.ratio - q) / rates[dof];
      if (there > 0) length = std::min(length, there);
      if (driven.sprung(dof))
        length = std::min(length, pull_step / std::abs(joint.ratio * rates[dof]));
    });
  }
  return length;
}

/// End of a path.
struct Followed {
  DrivePosture posture;
  Advance end;
  int queries = 0;
};

// follows the path until a DOF arrives or a pair touches
Followed follow(const DrivenRobot& driven, const DrivePosture& start, PairBounds& pairs,
                const Eigen::VectorXd& targets, const Eigen::VectorXd& rates) {
  Followed out{start, {}};
  const auto place = [&](double s) {
    Eigen::VectorXd& q = out.posture.dofs;
    q = start.dofs + s * rates;
    // a DOF that arrives is set exactly to its target
    for (int i = 0; i < rates.size(); ++i)
      if (rates[i] != 0 && std::abs(targets[i] - q[i]) <= arrived) q[i] = targets[i];
    driven.place(out.posture);
  };
  out.end = follow_path(driven, pairs, joint_speeds(driven, start.own, rates),
                        path_length(driven, start, targets, rates), place, out.queries);
  return out;
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

// stops all moving DOFs
void stop_all(DriveResult& result, const Eigen::VectorXd& rates, DofStop why) {
  for (int i = 0; i < rates.size(); ++i)
    if (rates[i] != 0) result.stops[i] = why;
}

/// Rates of the DOFs that have not reached their targets, and the stops of the others.
struct RatesLeft {
  Eigen::VectorXd rates;
  std::vector<std::pair<int, DofStop>> stops;  ///< of DOFs that were to move
};

RatesLeft without_arrived(const Robot& robot, const Eigen::VectorXd& dofs,
                          const Eigen::VectorXd& targets, const Eigen::VectorXd& rates) {
  RatesLeft out{rates, {}};
  for (int i = 0; i < rates.size(); ++i) {
    if (rates[i] * (targets[i] - dofs[i]) > 0) continue;
    if (rates[i] != 0) {
      const auto [low, high] = range_around(robot, i, dofs[i]);
      const bool at_limit = dofs[i] == low || dofs[i] == high;
      out.stops.emplace_back(i, at_limit ? DofStop::limit : DofStop::reached);
    }
    out.rates[i] = 0;
  }
  return out;
}

// Advances from event to event until nothing moves: springs come to rest, contacts stop DOFs, the
// others follow their path.
// motion   relative to the rate of the fastest DOF
// returns  the last posture
DrivePosture drive_on(const DrivenRobot& driven, DrivePosture posture, const DofMotion& motion,
                      const DriveOptions& options, DriveResult& result) {
  const auto& [targets, all_rates] = motion;
  PairBounds pairs = pairs_to_watch(driven);
  int unrest = 0;
  while (true) {
    driven.world.context().progress().check();
    check_stop();
    posture = re_engaged(driven, std::move(posture));
    RelaxedSprings relaxed = relax_springs(driven, posture, pairs, options);
    posture = std::move(relaxed.posture);
    result.queries += relaxed.queries;
    result.events += relaxed.events;
    if (relaxed.springs == Springs::stopped) {
      result.stopped_by = relaxed.stopped_by;
      stop_all(result, all_rates, DofStop::contact);
      return posture;
    }

    // the DOFs that have not arrived and are not blocked
    const RatesLeft left = without_arrived(driven.robot(), posture.dofs, targets, all_rates);
    for (const auto& [dof, why] : left.stops) result.stops[dof] = why;
    BlockedDofs blocked = find_blocked(driven, posture, left.rates, driven.touching());
    for (const int dof : blocked.stopped) result.stops[dof] = DofStop::contact;
    result.stopped_by = blocked.pairs;
    posture = std::move(blocked.posture);
    const Eigen::VectorXd& rates = blocked.rates;
    if (rates.isZero(0)) {
      if (relaxed.springs == Springs::at_rest) return posture;
      if (++unrest <= max_unrest) continue;
      for (int i = 0; i < rates.size(); ++i)
        if (driven.sprung(i)) result.stops[i] = DofStop::iteration_limit;
      return posture;
    }
    if (result.events >= max_events) {
      stop_all(result, rates, DofStop::iteration_limit);
      return posture;
    }

    Followed followed = follow(driven, posture, pairs, targets, rates);
    posture = std::move(followed.posture);
    result.queries += followed.queries;
    const Advance& end = followed.end;
    if (end.iteration_limit) {
      stop_all(result, rates, DofStop::iteration_limit);
      return posture;
    }
    if (!end.stopped_by) continue;
    ++result.events;
    if (options.stop_at_contact && !end.stopped_by->touching) {
      result.stopped_by = {{end.stopped_by->a, end.stopped_by->b}};
      stop_all(result, rates, DofStop::contact);
      return posture;
    }
  }
}

}  // namespace

DriveResult drive(World& world, Id<Robot> id, const DofMotion& motion,
                  const DriveOptions& options) {
  const Robot& robot = world.robot(id);
  check(robot, motion);
  const DrivenRobot driven{world, id, CarriedBodies(world, id)};
  DofMotion inside = motion;
  for (int i = 0; i < inside.targets.size(); ++i) {
    const auto [low, high] = range_around(robot, i, inside.targets[i]);
    inside.targets[i] = std::clamp(inside.targets[i], low, high);
  }
  refuse_collision(world, driven.bodies.movable(),
                   fmt::format("driving '{}'", excerpt(robot.name)));

  // the path does not depend on the pace: the rate of the fastest DOF is set to 1
  const double fastest = motion.rates.lpNorm<Eigen::Infinity>();
  inside.rates /= fastest > 0 ? fastest : 1;
  const Eigen::VectorXd dofs = world.dofs(id), joints = world.joints(id);
  DriveResult result;
  result.stops.assign(robot.dofs.size(), DofStop::not_driven);
  const DrivePosture start{world.dofs(id), world.own_joint_positions(id)};
  driven.place(drive_on(driven, start, inside, options, result));
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
