#include "model/carrying.h"

namespace clench {

std::pair<int, int> carrying_link(const World& world, Id<Robot> robot, Id<Body> id) {
  const Body& body = world.body(id);
  if (body.robot == robot) return {body.kind == BodyKind::link ? body.chain : -1, body.link};
  for (auto up = body.robot; up;) {
    const auto& mounting = world.robot(up).mounting;
    if (!mounting) break;
    if (mounting->parent == robot) {
      const int last =
          static_cast<int>(world.robot(robot).chains[mounting->chain].links.size()) - 1;
      return {mounting->chain, last};
    }
    up = mounting->parent;
  }
  return {-1, -1};
}

bool joint_moves(const World& world, Id<Robot> robot, JointPlace joint, Id<Body> body) {
  const auto [chain, link] = carrying_link(world, robot, body);
  return chain >= 0 && joint_moves_link(world.robot(robot), joint.first, joint.second, chain, link);
}

std::vector<Id<Body>> movable_bodies(const World& world, Id<Robot> robot) {
  std::vector<Id<Body>> out;
  for (const auto body : world.bodies())
    if (world.body(body).robot && carrying_link(world, robot, body).first >= 0) out.push_back(body);
  return out;
}

}  // namespace clench
