#include "clench/spec/closing_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "clench/base/random.h"

namespace clench {

namespace {

constexpr int samples = 256;       // of all DOFs, for the centre
constexpr int steps = 32;          // of a DOF from end to end
constexpr double along = 0.8;      // axes whose cosine exceeds this turn the same way
constexpr double hardly = 0.02;    // of the way of the tips: nearer by less is not nearer
constexpr double sideways = 0.15;  // the same for a DOF that swings a finger sideways
constexpr double rolling = 0.02;   // of the tips' distance to the centre: a shorter way is a roll
constexpr double lopsided = 0.1;   // of the range: a middle farther than this from 0 is no swing
constexpr double common = 0.4;     // mean of unit vectors: longer means they agree
constexpr double nearly_axis = 0.94;  // cosine of 20 degrees: a direction this near an axis is it

// a joint may turn this far and more without end [rad]
constexpr double endless = 1.5 * 2 * std::numbers::pi;

struct Finger {
  int tip = 0;             // link
  std::vector<int> links;  // between palm and tip, from the palm on, and the tip
  Eigen::Vector3d p_tip;   // in the tip's frame
};

int root_distance(const RobotSpec& robot, int link) {
  int n = 0;
  for (; link >= 0; link = robot.links[link].parent) ++n;
  return n;
}

int common_ancestor(const RobotSpec& robot, int a, int b) {
  int depth_a = root_distance(robot, a), depth_b = root_distance(robot, b);
  while (a != b) {
    if (depth_a >= depth_b)
      a = robot.links[a].parent, --depth_a;
    else
      b = robot.links[b].parent, --depth_b;
  }
  return a;
}

/// Links between an ancestor, which is not among them, and a link, which is; from the ancestor on.
std::vector<int> links_below(const RobotSpec& robot, int ancestor, int link) {
  std::vector<int> out;
  for (; link != ancestor && link >= 0; link = robot.links[link].parent) out.push_back(link);
  return {out.rbegin(), out.rend()};
}

/// Joints of those links.
std::vector<const JointSpec*> joints_below(const RobotSpec& robot, int ancestor, int link) {
  std::vector<const JointSpec*> out;
  for (const int l : links_below(robot, ancestor, link))
    for (const JointSpec& joint : robot.links[l].joints) out.push_back(&joint);
  return out;
}

const BodySpec& body_of(const RobotSpec& robot, int link) {
  return link < 0 ? robot.base : robot.links[link].body;
}

const ShapePtr& drawn(const BodySpec& body) {
  return body.shape ? body.shape : body.appearance.visual;
}

/// Links that end the tree: the last ones with geometry, or without when none has any.
std::vector<int> ends(const RobotSpec& robot) {
  const bool any_shape =
      drawn(robot.base) || std::any_of(robot.links.begin(), robot.links.end(),
                                       [](const LinkSpec& link) { return drawn(link.body); });
  std::vector<bool> goes_on(robot.links.size());
  std::vector<int> out;
  for (int i = static_cast<int>(robot.links.size()) - 1; i >= 0; --i) {
    const bool counts = !any_shape || drawn(robot.links[i].body);
    if (counts && !goes_on[i]) out.push_back(i);
    if (const int parent = robot.links[i].parent; parent >= 0)
      goes_on[parent] = goes_on[parent] || goes_on[i] || counts;
  }
  std::reverse(out.begin(), out.end());
  return out;
}

/// Values of all DOFs, and where they put the links in the base's frame.
struct Posture {
  std::vector<double> q;
  std::vector<Pose> poses;

  Pose at(int link) const { return link < 0 ? Pose{} : poses[link]; }
};

struct Hand {
  const RobotSpec& robot;
  int palm = -1;
  std::vector<Finger> fingers;
  std::vector<int> dofs;                      // that can move
  Posture rest;                               // at first
  std::vector<std::array<double, 2>> ranges;  // one per DOF

  /// Does the DOF go round and round?
  bool turns_without_end(int dof) const { return !(ranges[dof][1] - ranges[dof][0] < endless); }
};

void find_fingers(Hand& hand) {
  const RobotSpec& robot = hand.robot;
  std::vector<int> tips = ends(robot);
  std::erase_if(tips, [&](int tip) { return joints_below(robot, -1, tip).empty(); });
  // what is fixed on the palm is no finger, and without it the palm may lie farther out
  for (size_t before = tips.size() + 1; tips.size() > 1 && tips.size() < before;) {
    before = tips.size();
    hand.palm = tips.front();
    for (const int tip : tips) hand.palm = common_ancestor(robot, hand.palm, tip);
    std::erase_if(tips, [&](int tip) { return joints_below(robot, hand.palm, tip).empty(); });
  }
  // a single finger of one or two joints closes against what carries it; a longer one is an arm
  if (tips.size() == 1) {
    hand.palm = tips.front();
    while (joints_below(robot, hand.palm, tips.front()).empty() && hand.palm >= 0)
      hand.palm = robot.links[hand.palm].parent;
    const bool arm = joints_below(robot, -1, tips.front()).size() > 2;
    if (arm) tips.clear();
  }
  for (const int tip : tips) {
    const ShapePtr& shape = drawn(robot.links[tip].body);
    hand.fingers.push_back({tip, links_below(robot, hand.palm, tip),
                            shape ? shape->centre() : Eigen::Vector3d(Eigen::Vector3d::Zero())});
  }
}

Hand make_hand(const RobotSpec& robot) {
  Hand hand{robot, -1, {}, {}, {}, {}};
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) {
    hand.ranges.push_back(dof_range(robot, d));
    const auto [low, high] = hand.ranges.back();
    if (low < high) hand.dofs.push_back(d);
    const double start = robot.dofs[d].default_value;
    hand.rest.q.push_back(low <= high ? std::clamp(start, low, high) : start);
  }
  hand.rest.poses = link_poses(robot, hand.rest.q);
  find_fingers(hand);
  return hand;
}

/// Fingertips in the palm's frame.
std::vector<Eigen::Vector3d> tips_at(const Hand& hand, const std::vector<double>& q) {
  const Posture posture{q, link_poses(hand.robot, q)};
  const Pose X_PB = posture.at(hand.palm).inverse();
  std::vector<Eigen::Vector3d> out;
  for (const Finger& finger : hand.fingers)
    out.push_back(X_PB * (posture.at(finger.tip) * finger.p_tip));
  return out;
}

/// The tip of a finger alone, as all its joints are now; the palm stands where it does in `posture`.
/// Long hands would else take the square of their length.
Eigen::Vector3d tip_at(const Hand& hand, const Posture& posture, const std::vector<double>& q,
                       const Finger& finger) {
  Pose X = posture.at(hand.palm);
  for (const int l : finger.links) X = X * link_in_parent(hand.robot.links[l], q);
  return posture.at(hand.palm).inverse() * (X * finger.p_tip);
}

/// Fingers that a DOF moves; none when it moves the palm, too.
std::vector<int> moved_fingers(const Hand& hand, int dof) {
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
Eigen::Vector3d grasp_centre(const Hand& hand) {
  // a single finger closes on what carries it
  if (hand.fingers.size() == 1) {
    const ShapePtr& palm = drawn(body_of(hand.robot, hand.palm));
    return palm ? palm->centre() : Eigen::Vector3d(Eigen::Vector3d::Zero());
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
  }
  return sum / (samples * static_cast<double>(hand.fingers.size()));
}

/// Does some joint of the DOF turn its finger the way that the finger's last joint does?
bool flexes(const Hand& hand, int dof) {
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
  double nearer = 0;      // most that they come nearer to the centre [m]
  double nearest_at = 0;  // the way that they have gone there [m]
  double end = 0;         // nearer at the end [m]
  double far = 0;         // from the centre at first [m]
};

/// `fingers`: those that the DOF moves, whose palm it does not
Way way_to(const Hand& hand, const Posture& posture, int dof, const std::vector<int>& fingers,
           const Eigen::Vector3d& centre, double end) {
  Way way;
  auto q = posture.q;
  const double start = hand.rest.q[dof];
  std::vector<Eigen::Vector3d> before(fingers.size());
  double first = 0;
  for (int s = 0; s <= steps; ++s) {
    q[dof] = start + (end - start) * s / steps;
    double distance = 0;
    for (size_t f = 0; f < fingers.size(); ++f) {
      const Eigen::Vector3d tip = tip_at(hand, posture, q, hand.fingers[fingers[f]]);
      distance += (tip - centre).norm();
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
Posture half_way(const Hand& hand) {
  Posture out{hand.rest.q, {}};
  for (const int dof : hand.dofs) {
    const auto [least, most] = hand.ranges[dof];
    if (!hand.turns_without_end(dof)) out.q[dof] = (least + most) / 2;
  }
  out.poses = link_poses(hand.robot, out.q);
  return out;
}

double sense_of(const Hand& hand, const Posture& bent, int dof, const Eigen::Vector3d& centre) {
  const auto fingers = moved_fingers(hand, dof);
  const auto [low, high] = hand.ranges[dof];
  if (fingers.empty() || hand.turns_without_end(dof)) return 0;
  Way up = way_to(hand, hand.rest, dof, fingers, centre, high),
      down = way_to(hand, hand.rest, dof, fingers, centre, low);
  if (up.length + down.length < rolling * up.far) {
    // a straight finger about its own axis: where it goes shows when it is bent
    up = way_to(hand, bent, dof, fingers, centre, high);
    down = way_to(hand, bent, dof, fingers, centre, low);
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

Eigen::Vector3d snapped(const Eigen::Vector3d& direction) {
  Eigen::Index axis;
  const double largest = direction.cwiseAbs().maxCoeff(&axis);
  if (largest < nearly_axis) return direction;
  return std::copysign(1.0, direction[axis]) * Eigen::Vector3d::Unit(axis);
}

/// The way that the tips go as the hand begins to close, when they agree; else the way that the
/// fingers point.
Eigen::Vector3d approach_direction(const Hand& hand, const std::vector<double>& senses,
                                   const Eigen::Vector3d& centre) {
  auto from = hand.rest.q, to = hand.rest.q;
  for (const int dof : hand.dofs) {
    if (senses[dof] == 0) continue;
    const auto [low, high] = hand.ranges[dof];
    const double little = 0.05 * (high - low) * senses[dof];
    double start = hand.rest.q[dof];
    if (start + little > high || start + little < low) start -= little;
    from[dof] = start;
    to[dof] = start + little;
  }
  const auto before = tips_at(hand, from), after = tips_at(hand, to);
  Eigen::Vector3d closing = Eigen::Vector3d::Zero(), pointing = closing;
  const Pose X_PB = hand.rest.at(hand.palm).inverse();
  for (size_t f = 0; f < hand.fingers.size(); ++f) {
    closing += (after[f] - before[f]).stableNormalized() / static_cast<double>(hand.fingers.size());
    // from the finger's first link to its tip
    const Pose first = hand.rest.at(hand.fingers[f].links.front());
    pointing += (before[f] - X_PB * first.position).stableNormalized();
  }
  if (closing.norm() > common) return closing.normalized();
  if (pointing.norm() > 1e-6) return pointing.normalized();
  const ShapePtr& palm = drawn(body_of(hand.robot, hand.palm));
  const Eigen::Vector3d out =
      centre - (palm ? palm->centre() : Eigen::Vector3d(Eigen::Vector3d::Zero()));
  return out.norm() > 1e-9 ? Eigen::Vector3d(out.normalized())
                           : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
}

/// On the palm's surface, where it bulges most in the direction.
Eigen::Vector3d approach_point(const Hand& hand, const Eigen::Vector3d& direction_P) {
  int link = hand.palm;
  while (link >= 0 && !drawn(body_of(hand.robot, link))) link = hand.robot.links[link].parent;
  const ShapePtr& shape = drawn(body_of(hand.robot, link));
  if (!shape) return Eigen::Vector3d::Zero();
  const Pose X_PL = hand.rest.at(hand.palm).inverse() * hand.rest.at(link);
  const Eigen::Vector3d centre = X_PL * shape->bounds().centre();
  double farthest = 0;
  for (const auto& p : shape->mesh().vertices)
    farthest = std::max(farthest, direction_P.dot(X_PL * p - centre));
  return centre + farthest * direction_P;
}

}  // namespace

ClosingGuess guess_closing(const RobotSpec& robot, const std::vector<bool>& passive) {
  const Hand hand = make_hand(robot);
  ClosingGuess guess;
  guess.senses.assign(robot.dofs.size(), 0);
  if (hand.fingers.empty()) return guess;
  const Eigen::Vector3d centre = grasp_centre(hand);
  if (!centre.allFinite()) return guess;
  const Posture bent = half_way(hand);
  for (const int dof : hand.dofs)
    if (!passive[dof]) guess.senses[dof] = sense_of(hand, bent, dof, centre);

  const Eigen::Vector3d z_P = approach_direction(hand, guess.senses, centre);
  const Eigen::Vector3d p_P = approach_point(hand, z_P);
  const Pose X_BP = hand.rest.at(hand.palm);
  const Eigen::Vector3d z_B = snapped(X_BP.rotation * z_P), p_B = X_BP * p_P;
  if (z_B.allFinite() && p_B.allFinite()) guess.X_BA = approach_frame(p_B, z_B);
  return guess;
}

}  // namespace clench
