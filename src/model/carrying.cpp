#include "clench/model/carrying.h"

namespace clench {

int carrying_link(const World& world, Id<Robot> robot, Id<Body> id) {
  const Body& body = world.body(id);
  if (body.robot == robot) return body.link;
  for (auto up = body.robot; up;) {
    const auto& mounting = world.robot(up).mounting;
    if (!mounting) break;
    if (mounting->parent == robot) return mounting->link;
    up = mounting->parent;
  }
  return -1;
}

bool joint_moves(const World& world, Id<Robot> robot, int joint, Id<Body> body) {
  return joint_moves_link(world.robot(robot), joint, carrying_link(world, robot, body));
}

std::vector<Id<Body>> movable_bodies(const World& world, Id<Robot> robot) {
  std::vector<Id<Body>> out;
  for (const auto body : world.bodies())
    if (world.body(body).robot && carrying_link(world, robot, body) >= 0) out.push_back(body);
  return out;
}

}  // namespace clench
