#include "clench/scene/touched.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace clench {
namespace {

// the last link that carries both; -1: the base
int common(const Robot& robot, int a, int b) {
  while (a != b) (a > b ? a : b) = robot.links[std::max(a, b)].parent;
  return a;
}

// how many branches begin on each link in which something moves
std::vector<int> moving_branches(const Robot& robot) {
  const int n = static_cast<int>(robot.links.size());
  std::vector<int> branches(n, 0);
  for (int i = n - 1; i >= 0; --i) {
    const Link& link = robot.links[i];
    const bool moves = link.end_joint > link.first_joint || branches[i] > 0;
    if (moves && link.parent >= 0) ++branches[link.parent];
  }
  return branches;
}

// the links from the palm outward
std::vector<bool> holding_links(const Robot& robot, std::span<const int> touching) {
  int palm = touching[0];
  for (const int link : touching) palm = common(robot, palm, link);
  const std::vector<int> branches = moving_branches(robot);
  while (palm >= 0 && branches[palm] < 2) palm = robot.links[palm].parent;
  std::vector<bool> out(robot.links.size());
  for (size_t i = 0; i < out.size(); ++i) {
    const int parent = robot.links[i].parent;
    out[i] = palm < 0 || static_cast<int>(i) == palm || (parent >= 0 && out[parent]);
  }
  return out;
}

}  // namespace

std::set<Id<Body>> touched_bodies(const World& world, std::span<const Contact> contacts) {
  std::set<Id<Body>> out;
  std::map<Id<Robot>, std::vector<int>> touching;
  for (const Contact& contact : contacts) {
    for (const auto& [object, part] :
         {std::pair(contact.body, contact.other), std::pair(contact.other, contact.body)}) {
      const Id<Robot> robot = world.body(part).robot;
      if (world.body(object).kind != BodyKind::object || !robot) continue;
      out.insert(object);
      touching[robot].push_back(world.body(part).link);
    }
  }
  for (const auto& [id, links] : touching) {
    const Robot& robot = world.robot(id);
    const std::vector<bool> holding = holding_links(robot, links);
    for (size_t i = 0; i < holding.size(); ++i)
      if (holding[i]) out.insert(robot.links[i].body);
  }
  return out;
}

}  // namespace clench
