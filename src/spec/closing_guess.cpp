#include "clench/spec/closing_guess.h"

#include <algorithm>
#include <cmath>

#include "clench/base/random.h"
#include "clench/base/watched.h"
#include "clench/spec/hand_tree.h"

namespace clench {

namespace {

constexpr int samples = 256;       // of all DOFs, for the center
constexpr int steps = 32;          // of a DOF from end to end
constexpr double along = 0.8;      // axes or ways whose cosine exceeds this are the same way
constexpr double hardly = 0.02;    // of the way of the tips: nearer by less is not nearer
constexpr double sideways = 0.15;  // the same for a DOF that swings a finger sideways
constexpr double rolling = 0.02;   // of the tips' distance to the center: a shorter way is a roll
constexpr double lopsided = 0.1;   // of the range: a middle farther than this from 0 is no swing

/// The tip of a finger alone, as all its joints are now; the palm stands where it does in
/// `posture`. Long hands would else take the square of their length.
Eigen::Vector3d tip_at(const HandTree& hand, const Posture& posture, const std::vector<double>& q,
                       const Finger& finger) {
  Pose X = posture.at(hand.palm);
  for (const int l : finger.links) X = X * link_in_parent(hand.robot.links[l], q);
  return posture.at(hand.palm).inverse() * (X * finger.p_tip);
}

/// Fingers that a DOF moves; none when it moves the palm, too.
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

/// Where the tips are on average, in the palm's frame.
Eigen::Vector3d grasp_center(const HandTree& hand) {
  // a single finger closes on what carries it
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
      // what turns without end, turns nothing in on average
      if (!hand.turns_without_end(dof)) q[dof] = value;
    }
    for (const auto& p : tips_at(hand, q)) sum += p;
    check_stop();
  }
  return sum / (samples * static_cast<double>(hand.fingers.size()));
}

/// Does some joint of the DOF turn its finger the way that the finger's last joint does?
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

/// What the tips do while one DOF goes from where it is to an end.
struct Way {
  double length = 0;      // that the tips go [m]
  double nearer = 0;      // most that they come nearer to the center [m]
  double nearest_at = 0;  // the way that they have gone there [m]
  double end = 0;         // nearer at the end [m]
  double far = 0;         // from the center at first [m]
};

/// `fingers`: those that the DOF moves, whose palm it does not
Way way_to(const HandTree& hand, const Posture& posture, int dof, const std::vector<int>& fingers,
           const Eigen::Vector3d& center, double end) {
  Way way;
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
      if (s > 0) way.length += (tip - before[f]).norm();
      before[f] = tip;
    }
    if (s == 0) first = way.far = distance;
    way.end = first - distance;
    if (way.end > way.nearer) way.nearer = way.end, way.nearest_at = way.length;
  }
  return way;
}

/// Every DOF at half its way, but those that turn without end.
Posture half_way(const HandTree& hand) {
  Posture out{hand.rest.q, {}};
  for (const int dof : hand.dofs) {
    const auto [least, most] = hand.ranges[dof];
    if (!hand.turns_without_end(dof)) out.q[dof] = (least + most) / 2;
  }
  out.poses = link_poses(hand.robot, out.q);
  return out;
}

/// Which way each tip goes, in the palm's frame, as DOFs go a quarter of the way to an end; zero:
/// it stays.
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

/// Does a finger that the DOF leaves where it is close the way that one does that it moves?
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
  Way up = way_to(hand, hand.rest, dof, fingers, center, high),
      down = way_to(hand, hand.rest, dof, fingers, center, low);
  if (up.length + down.length < rolling * up.far) {
    // a straight finger about its own axis: where it goes shows when it is bent
    up = way_to(hand, bent, dof, fingers, center, high);
    down = way_to(hand, bent, dof, fingers, center, low);
  }
  const double length = up.length + down.length;
  if (!(length > 0)) return 0;
  const Way& better = up.nearer > down.nearer ? up : down;
  const double sense = &better == &up ? 1 : -1;
  if (!flexes(hand, dof)) {
    if (std::abs(low + high) < lopsided * (high - low)) return 0;
    return better.nearer > sideways * better.nearest_at ? sense : 0;
  }
  if (better.nearer > hardly * length) return sense;
  // it stands shut: back to there, from the side where it opens
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
  std::vector<int> swings;  // DOFs that swing fingers sideways: the others tell how these close
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
