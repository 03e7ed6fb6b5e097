#include "clench/spec/closing_guess.h"

#include <algorithm>
#include <cmath>

#include "clench/base/random.h"
#include "clench/base/watched.h"
#include "clench/spec/hand_tree.h"

namespace clench {

namespace {

constexpr int samples = 256;   // samples of all DOFs, for the center
constexpr int steps = 32;      // steps of a DOF from end to end
constexpr double along = 0.8;  // axes or directions with a larger cosine count as equal
// relative to the travel of the tips: smaller approaches do not count
constexpr double hardly = 0.02;
constexpr double sideways = 0.15;  // the same for a DOF that swings a finger sideways
// relative to the tips' distance from the center: a DOF with a shorter travel only rolls the finger
constexpr double rolling = 0.02;
// relative to the range: if its middle is farther from 0, the DOF does not swing
constexpr double lopsided = 0.1;

/// Position of a finger's tip for the present values of its joints; the palm has its pose in
/// `posture`. Only the finger is updated, since updating long hands would take quadratic time.
Eigen::Vector3d tip_at(const HandTree& hand, const Posture& posture, const std::vector<double>& q,
                       const Finger& finger) {
  Pose X = posture.at(hand.palm);
  for (const int l : finger.links) X = X * link_in_parent(hand.robot.links[l], q);
  return posture.at(hand.palm).inverse() * (X * finger.p_tip);
}

/// Fingers moved by a DOF; empty if it moves the palm, too.
std::vector<int> moved_fingers(const HandTree& hand, int dof) {
  const auto moves = [&](int from, int to) {
    const auto joints = joints_below(hand.robot, from, to);
    return std::any_of(joints.begin(), joints.end(),
                       [&](const JointSpec* joint) { return joint->dof == dof; });
  };
  std::vector<int> out;
  if (moves(-1, hand.palm)) return out;
  for (int f = 0; f < static_cast<int>(hand.fingers.size()); ++f)
    if (moves(hand.palm, hand.fingers[f].tip)) out.push_back(f);
  return out;
}

/// Mean position of the tips, in the palm's frame.
Eigen::Vector3d grasp_center(const HandTree& hand) {
  // a single finger closes on its carrier
  if (hand.fingers.size() == 1) {
    const ShapePtr& palm = drawn(body_of(hand.robot, hand.palm));
    return palm ? palm->center() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int s = 0; s < samples; ++s) {
    Random random(1, static_cast<uint64_t>(s));
    auto q = hand.rest.q;
    for (const int dof : hand.dofs) {
      const auto [low, high] = hand.ranges[dof];
      const double value = random.uniform(low, high);
      // the mean of a DOF that turns without end is arbitrary
      if (!hand.turns_without_end(dof)) q[dof] = value;
    }
    for (const auto& p : tips_at(hand, q)) sum += p;
    check_stop();
  }
  return sum / (samples * static_cast<double>(hand.fingers.size()));
}

/// Does any joint of the DOF turn its finger in the same direction as the finger's last joint?
bool flexes(const HandTree& hand, int dof) {
  for (const Finger& finger : hand.fingers) {
    std::vector<std::pair<const JointSpec*, Eigen::Vector3d>> axes;  // in the base
    for (const int l : finger.links) {
      Pose X = hand.rest.at(hand.robot.links[l].parent);
      for (const JointSpec& joint : hand.robot.links[l].joints) {
        X = X * joint.X_PJ;
        axes.emplace_back(&joint, X.rotation * joint.axis);
        X = X * joint_motion(joint, joint.ratio * hand.rest.q[joint.dof]);
      }
    }
    for (const auto& [joint, axis] : axes) {
      if (joint->dof != dof) continue;
      if (joint->kind == JointKind::prismatic) return true;
      if (std::abs(axis.dot(axes.back().second)) > along) return true;
    }
  }
  return false;
}

/// Motion of the tips while one DOF moves from its present value to an end.
struct TipPath {
  double length = 0;      // length of the tips' paths [m]
  double nearer = 0;      // maximum decrease of their distance from the center [m]
  double nearest_at = 0;  // path length at that point [m]
  double end = 0;         // decrease at the end [m]
  double far = 0;         // initial distance from the center [m]
};

/// `fingers`: those moved by the DOF; it does not move their palm
TipPath trace_tips(const HandTree& hand, const Posture& posture, int dof,
                   const std::vector<int>& fingers, const Eigen::Vector3d& center, double end) {
  TipPath path;
  auto q = posture.q;
  const double start = hand.rest.q[dof];
  std::vector<Eigen::Vector3d> before(fingers.size());
  double first = 0;
  for (int s = 0; s <= steps; ++s) {
    check_stop();
    q[dof] = start + (end - start) * s / steps;
    double distance = 0;
    for (size_t f = 0; f < fingers.size(); ++f) {
      const Eigen::Vector3d tip = tip_at(hand, posture, q, hand.fingers[fingers[f]]);
      distance += (tip - center).norm();
      if (s > 0) path.length += (tip - before[f]).norm();
      before[f] = tip;
    }
    if (s == 0) first = path.far = distance;
    path.end = first - distance;
    if (path.end > path.nearer) path.nearer = path.end, path.nearest_at = path.length;
  }
  return path;
}

/// Every DOF at the middle of its range, except those that turn without end.
Posture half_way(const HandTree& hand) {
  Posture out{hand.rest.q, {}};
  for (const int dof : hand.dofs) {
    const auto [least, most] = hand.ranges[dof];
    if (!hand.turns_without_end(dof)) out.q[dof] = (least + most) / 2;
  }
  out.poses = link_poses(hand.robot, out.q);
  return out;
}

/// Direction in which each tip moves, in the palm's frame, as DOFs move a quarter of the way to an
/// end; zero: it does not move.
std::vector<Eigen::Vector3d> ways_of_tips(const HandTree& hand, const std::vector<double>& senses) {
  auto q = hand.rest.q;
  for (const int dof : hand.dofs) {
    const auto [low, high] = hand.ranges[dof];
    if (senses[dof] != 0) q[dof] += 0.25 * ((senses[dof] > 0 ? high : low) - q[dof]);
  }
  std::vector<Eigen::Vector3d> out;
  for (const Finger& finger : hand.fingers) {
    const Eigen::Vector3d before = tip_at(hand, hand.rest, hand.rest.q, finger);
    out.push_back((tip_at(hand, hand.rest, q, finger) - before).stableNormalized());
  }
  return out;
}

/// Does a finger that the DOF does not move close in the same direction as one that it moves?
bool beside_another(const HandTree& hand, int dof, const std::vector<Eigen::Vector3d>& ways) {
  const auto moved = moved_fingers(hand, dof);
  for (int f = 0; f < static_cast<int>(hand.fingers.size()); ++f) {
    if (std::ranges::count(moved, f) > 0) continue;
    for (const int g : moved)
      if (ways[f].dot(ways[g]) > along) return true;
  }
  return false;
}

double sense_of(const HandTree& hand, const Posture& bent, int dof, const Eigen::Vector3d& center) {
  const auto fingers = moved_fingers(hand, dof);
  const auto [low, high] = hand.ranges[dof];
  if (fingers.empty() || hand.turns_without_end(dof)) return 0;
  TipPath up = trace_tips(hand, hand.rest, dof, fingers, center, high),
          down = trace_tips(hand, hand.rest, dof, fingers, center, low);
  if (up.length + down.length < rolling * up.far) {
    // a straight finger about its own axis: its direction shows when it is bent
    up = trace_tips(hand, bent, dof, fingers, center, high);
    down = trace_tips(hand, bent, dof, fingers, center, low);
  }
  const double length = up.length + down.length;
  if (!(length > 0)) return 0;
  const TipPath& better = up.nearer > down.nearer ? up : down;
  const double sense = &better == &up ? 1 : -1;
  if (!flexes(hand, dof)) {
    if (std::abs(low + high) < lopsided * (high - low)) return 0;
    return better.nearer > sideways * better.nearest_at ? sense : 0;
  }
  if (better.nearer > hardly * length) return sense;
  // initially closed: back to that position, from the side where it opens
  const double opens = up.end < down.end ? 1 : -1;
  return std::min(up.end, down.end) < -hardly * length ? -opens : 0;
}

}  // namespace

std::vector<double> guess_closing(const RobotSpec& robot, const std::vector<bool>& passive) {
  const HandTree hand = hand_tree(robot);
  std::vector<double> senses(robot.dofs.size());
  if (hand.fingers.empty()) return senses;
  const Eigen::Vector3d center = grasp_center(hand);
  if (!center.allFinite()) return senses;
  const Posture bent = half_way(hand);
  // DOFs that swing fingers sideways: the others determine how these close
  std::vector<int> swings;
  for (const int dof : hand.dofs) {
    if (passive[dof]) continue;
    senses[dof] = sense_of(hand, bent, dof, center);
    if (senses[dof] != 0 && !flexes(hand, dof)) swings.push_back(dof);
  }
  auto flexing = senses;
  for (const int dof : swings) flexing[dof] = 0;
  const auto ways = ways_of_tips(hand, flexing);
  for (const int dof : swings)
    if (beside_another(hand, dof, ways)) senses[dof] = 0;
  return senses;
}

}  // namespace clench
