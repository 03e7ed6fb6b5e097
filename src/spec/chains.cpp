#include "clench/spec/chains.h"

#include <fmt/format.h>

#include <set>

namespace clench {

// for each link the child that continues its chain; -1: none
static std::vector<int> ways_on(const RobotSpec& robot) {
  const int count = static_cast<int>(robot.links.size());
  std::vector<char> moves(count);  // does the link or its subtree have a joint?
  for (int i = count - 1; i >= 0; --i) {
    moves[i] = moves[i] || !robot.links[i].joints.empty();
    if (const int parent = robot.links[i].parent; moves[i] && parent >= 0) moves[parent] = true;
  }
  std::vector<int> moving(count), first(count, -1), first_moving(count, -1);
  for (int i = 0; i < count; ++i) {
    const int parent = robot.links[i].parent;
    if (parent < 0) continue;
    if (first[parent] < 0) first[parent] = i;
    if (!moves[i]) continue;
    ++moving[parent];
    if (first_moving[parent] < 0) first_moving[parent] = i;
  }
  std::vector<int> out(count, -1);
  for (int i = 0; i < count; ++i)
    out[i] = moving[i] == 1 ? first_moving[i] : moving[i] == 0 ? first[i] : -1;
  return out;
}

std::vector<Chain> chains_of(const RobotSpec& robot) {
  const auto way_on = ways_on(robot);
  std::vector<Chain> out;
  std::vector<int> chain_of;
  for (int i = 0; i < static_cast<int>(robot.links.size()); ++i) {
    const int parent = robot.links[i].parent;
    if (parent < 0 || way_on[parent] != i) {
      chain_of.push_back(static_cast<int>(out.size()));
      out.push_back({parent, {}});
    } else {
      chain_of.push_back(chain_of[parent]);
    }
    out[chain_of.back()].links.push_back(i);
  }
  return out;
}

ChainPlace place_of(const std::vector<Chain>& chains, int link) {
  for (int c = 0; link >= 0 && c < static_cast<int>(chains.size()); ++c)
    for (int l = 0; l < static_cast<int>(chains[c].links.size()); ++l)
      if (chains[c].links[l] == link) return {c, l};
  return {};
}

std::optional<int> link_at(const std::vector<Chain>& chains, ChainPlace place) {
  if (place.chain < 0) return -1;
  if (place.chain >= static_cast<int>(chains.size())) return {};
  const auto& links = chains[place.chain].links;
  if (place.link < 0 || place.link >= static_cast<int>(links.size())) return {};
  return links[place.link];
}

std::optional<int> chain_ending_at(const RobotSpec& robot, int link) {
  const auto chains = chains_of(robot);
  for (size_t c = 0; c < chains.size(); ++c)
    if (chains[c].links.back() == link) return static_cast<int>(c);
  return {};
}

std::vector<NumberedJoint> joints_of(const RobotSpec& robot) {
  const auto chains = chains_of(robot);
  std::vector<int> chain_of(robot.links.size());
  for (size_t c = 0; c < chains.size(); ++c)
    for (const int link : chains[c].links) chain_of[link] = static_cast<int>(c);
  std::vector<int> counts(chains.size());
  std::vector<NumberedJoint> out;
  for (size_t l = 0; l < robot.links.size(); ++l)
    for (const JointSpec& joint : robot.links[l].joints)
      out.push_back({chain_of[l], counts[chain_of[l]]++, &joint});
  return out;
}

// for each DOF the joint that has its value, or its negative, otherwise the first
static std::vector<const JointSpec*> leading_joints(const std::vector<NumberedJoint>& joints,
                                                    size_t dofs) {
  std::vector<const JointSpec*> out(dofs);
  for (const double ratio : {1.0, -1.0, 0.0})
    for (const NumberedJoint& one : joints)
      if (const auto dof = static_cast<size_t>(one.joint->dof);
          !out[dof] && (ratio == 0 || one.joint->ratio == ratio))
        out[dof] = one.joint;
  return out;
}

std::vector<std::string> joint_names_of(const std::vector<NumberedJoint>& joints,
                                        const std::vector<DofSpec>& dofs) {
  const auto leaders = leading_joints(joints, dofs.size());
  std::set<std::string> given, taken;
  for (const NumberedJoint& one : joints) given.insert(one.joint->name);
  std::vector<std::string> out;
  for (const NumberedJoint& one : joints) {
    const JointSpec& joint = *one.joint;
    const auto dof = static_cast<size_t>(joint.dof);
    std::string name = joint.name;
    if (name.empty() && leaders[dof] == &joint) {
      const std::string own =
          dofs[dof].name.empty() ? fmt::format("dof{}", dof + 1) : dofs[dof].name;
      if (!given.contains(own)) name = own;
    }
    if (name.empty()) name = fmt::format("chain{}_joint{}", one.chain, one.number);
    std::string only = name;
    for (int i = 2; !taken.insert(only).second; ++i) only = fmt::format("{}_{}", name, i);
    out.push_back(std::move(only));
  }
  return out;
}

std::vector<int> order_by_chains(RobotSpec& robot) {
  std::vector<int> now(robot.links.size());
  std::vector<LinkSpec> links;
  for (const Chain& chain : chains_of(robot))
    for (const int link : chain.links) {
      now[link] = static_cast<int>(links.size());
      links.push_back(std::move(robot.links[link]));
    }
  for (LinkSpec& link : links)
    if (link.parent >= 0) link.parent = now[link.parent];
  robot.links = std::move(links);
  return now;
}

}  // namespace clench
