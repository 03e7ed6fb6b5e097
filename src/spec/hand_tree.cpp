#include "clench/spec/hand_tree.h"

#include <algorithm>
#include <numbers>

namespace clench {

// a joint with at least this range turns without end [rad]
static constexpr double endless_range = 1.5 * 2 * std::numbers::pi;

static int root_distance(const RobotSpec& robot, int link) {
  int n = 0;
  for (; link >= 0; link = robot.links[link].parent) ++n;
  return n;
}

static int common_ancestor(const RobotSpec& robot, int a, int b) {
  int depth_a = root_distance(robot, a), depth_b = root_distance(robot, b);
  while (a != b) {
    if (depth_a >= depth_b)
      a = robot.links[a].parent, --depth_a;
    else
      b = robot.links[b].parent, --depth_b;
  }
  return a;
}

// Links between an ancestor (excluded) and a link (included), from the ancestor on.
static std::vector<int> links_below(const RobotSpec& robot, int ancestor, int link) {
  std::vector<int> out;
  for (; link != ancestor && link >= 0; link = robot.links[link].parent) out.push_back(link);
  return {out.rbegin(), out.rend()};
}

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

// Leaves of the tree: the last links with geometry, or without if none has any.
static std::vector<int> ends(const RobotSpec& robot) {
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

bool HandTree::turns_without_end(int dof) const {
  return !(ranges[dof][1] - ranges[dof][0] < endless_range);
}

static void find_fingers(HandTree& hand) {
  const RobotSpec& robot = hand.robot;
  std::vector<int> tips = ends(robot);
  std::erase_if(tips, [&](int tip) { return joints_below(robot, -1, tip).empty(); });
  // parts fixed to the palm are not fingers; without them the palm may be a link farther out
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
                            shape ? shape->center() : Eigen::Vector3d(Eigen::Vector3d::Zero())});
  }
}

HandTree hand_tree(const RobotSpec& robot) {
  HandTree hand{robot, -1, {}, {}, {}, {}};
  for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d) {
    hand.ranges.push_back(dof_range(robot, d));
    const auto [low, high] = hand.ranges.back();
    if (low < high) hand.dofs.push_back(d);
    const double start = robot.dofs[d].default_value;
    hand.rest.q.push_back(low <= high && !dof_is_endless(robot, d) ? std::clamp(start, low, high)
                                                                   : start);
  }
  hand.rest.poses = link_poses(robot, hand.rest.q);
  find_fingers(hand);
  return hand;
}

std::vector<Eigen::Vector3d> tips_at(const HandTree& hand, const std::vector<double>& q) {
  const Posture posture{q, link_poses(hand.robot, q)};
  const Pose X_PB = posture.at(hand.palm).inverse();
  std::vector<Eigen::Vector3d> out;
  for (const Finger& finger : hand.fingers)
    out.push_back(X_PB * (posture.at(finger.tip) * finger.p_tip));
  return out;
}

}  // namespace clench
