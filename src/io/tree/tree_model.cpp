#include "clench/io/tree/tree_model.h"

#include <algorithm>

#include "clench/base/text.h"

namespace clench {

Pose joint_pose(const TreeJoint& joint, double q) {
  const double way = q - joint.zero;
  if (joint.kind == JointKind::prismatic) return Pose::translation(way * joint.axis);
  return Pose::translation(joint.anchor) * Pose::turn(way, joint.axis) *
         Pose::translation(-joint.anchor);
}

void resolve_leaders(TreeModel& tree) {
  const int count = static_cast<int>(tree.joints.size());
  for (auto& joint : tree.joints) {
    if (joint.leader == &joint - tree.joints.data())
      fail("{}: joint '{}' follows itself", joint.place, excerpt(joint.name));
    const std::string first = joint.leader < 0 ? "" : tree.joints[joint.leader].name;
    int steps = 0;
    while (joint.leader >= 0 && tree.joints[joint.leader].leader >= 0) {
      const TreeJoint& before = tree.joints[joint.leader];
      // a sequence of leaders longer than the number of joints is a cycle
      if (++steps > count)
        fail("{}: joint '{}' follows itself via '{}'", joint.place, excerpt(joint.name),
             excerpt(first));
      joint.offset += joint.ratio * before.offset;
      joint.ratio *= before.ratio;
      joint.leader = before.leader;
    }
  }
}

/// Indices of the links from the root to this link.
static std::vector<int> path_to(const TreeModel& tree, int link) {
  std::vector<int> way;
  for (; link >= 0; link = tree.links[link].parent) way.push_back(link);
  return {way.rbegin(), way.rend()};
}

/// The depth-first order of links in which the branch that contains `first` precedes that of
/// `second`. Empty if one is distal to the other.
static std::vector<int> swapped(const TreeModel& tree, int first, int second) {
  const auto a = path_to(tree, first), b = path_to(tree, second);
  const auto [in_a, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  if (in_a == a.end() || in_b == b.end()) return {};
  std::vector<std::vector<int>> below(tree.links.size());
  for (int i = 1; i < static_cast<int>(tree.links.size()); ++i)
    below[tree.links[i].parent].push_back(i);
  auto& row = below[tree.links[*in_a].parent];
  row.erase(std::find(row.begin(), row.end(), *in_a));
  row.insert(std::find(row.begin(), row.end(), *in_b), *in_a);
  std::vector<int> order, stack = {0};
  while (!stack.empty()) {
    const int link = stack.back();
    stack.pop_back();
    order.push_back(link);
    stack.insert(stack.end(), below[link].rbegin(), below[link].rend());
  }
  return order;
}

static void reorder(TreeModel& tree, const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  std::vector<TreeLink> links;
  for (const int old : order) {
    links.push_back(std::move(tree.links[old]));
    if (links.back().parent >= 0) links.back().parent = place[links.back().parent];
  }
  tree.links = std::move(links);
  for (auto& [a, b] : tree.never_meet) a = place[a], b = place[b];
}

void order_branches(TreeModel& tree) {
  for (int leader = 0; leader < static_cast<int>(tree.joints.size()); ++leader) {
    if (tree.joints[leader].leader >= 0) continue;
    // links of the DOF's first joint and of its leader
    int first = -1, first_link = -1, own_link = -1;
    for (int l = 0; l < static_cast<int>(tree.links.size()); ++l)
      for (const int j : tree.links[l].joints) {
        if (j == leader) own_link = l;
        if (first >= 0 ||
            (j != leader && (tree.joints[j].leader != leader || tree.joints[j].ratio == 0)))
          continue;
        first = j, first_link = l;
      }
    if (first < 0 || own_link < 0 || tree.joints[first].kind == tree.joints[leader].kind) continue;
    if (const auto order = swapped(tree, own_link, first_link); !order.empty())
      reorder(tree, order);
  }
}

}  // namespace clench
