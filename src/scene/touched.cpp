#include "clench/scene/touched.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace clench {
namespace {

// the last common ancestor of two links; -1: the base
int common(const Robot& robot, int a, int b) {
  while (a != b) (a > b ? a : b) = robot.links[std::max(a, b)].parent;
  return a;
}

// number of branches that begin on each link and contain a moving joint
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

bool has_surface(const World& world, Id<Body> id) {
  const Body& body = world.body(id);
  return body.shape || body.appearance.visual;
}

// the last link that carries all touching links and has two moving branches; -1: the base
int palm_of(const World& world, const Robot& robot, std::span<const int> touching) {
  int palm = touching[0];
  for (const int link : touching) palm = common(robot, palm, link);
  const std::vector<int> branches = moving_branches(robot);
  while (palm >= 0 && branches[palm] < 2) palm = robot.links[palm].parent;
  // a frame without a surface: the palm is the body that it is fixed to
  while (palm >= 0 && !has_surface(world, robot.links[palm].body) &&
         robot.links[palm].end_joint == robot.links[palm].first_joint)
    palm = robot.links[palm].parent;
  return palm;
}

// the bodies from the palm outward
void add_holding(const World& world, const Robot& robot, std::span<const int> touching,
                 std::set<Id<Body>>& out) {
  const int palm = palm_of(world, robot, touching);
  if (palm < 0) out.insert(robot.base);
  std::vector<bool> holds(robot.links.size());
  for (size_t i = 0; i < holds.size(); ++i) {
    const int parent = robot.links[i].parent;
    holds[i] = palm < 0 || static_cast<int>(i) == palm || (parent >= 0 && holds[parent]);
    if (holds[i]) out.insert(robot.links[i].body);
  }
}

}  // namespace

std::vector<Contact> contacts_on_objects(const World& world) {
  std::vector<Id<Body>> parts, objects;
  for (const Id<Body> id : world.bodies()) {
    const BodyKind kind = world.body(id).kind;
    if (kind == BodyKind::object)
      objects.push_back(id);
    else if (kind != BodyKind::obstacle)
      parts.push_back(id);
  }
  return contacts(world, parts, objects);
}

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
  for (const auto& [id, links] : touching) add_holding(world, world.robot(id), links, out);
  return out;
}

}  // namespace clench
