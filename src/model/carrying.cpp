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

CarriedBodies::CarriedBodies(const World& world, Id<Robot> id)
    : movable_(movable_bodies(world, id)), link_count_(world.robot(id).links.size()) {
  for (const auto body : world.bodies()) {
    if (body.index >= links_.size()) links_.resize(body.index + 1, -1);
    links_[body.index] = carrying_link(world, id, body);
  }
  const Robot& robot = world.robot(id);
  for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j)
    for (int l = 0; l < static_cast<int>(link_count_); ++l)
      moves_.push_back(joint_moves_link(robot, j, l));
}

}  // namespace clench
