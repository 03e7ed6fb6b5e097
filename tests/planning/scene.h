// A shipped hand and an object, for tests of planning.
#pragma once
#include "clench/io/read/read.h"
#include "clench/model/build.h"
#include "clench/planning/space/search_space.h"

namespace clench::test {

struct HandScene {
  World world;
  Id<Robot> hand;
  Id<Body> object;

  const Robot& robot() const { return world.robot(hand); }
  HandState state() const {
    return {world.pose(object).inverse() * world.pose(robot().base), world.dofs(hand)};
  }
};

/// file  below models/hands and models/objects
inline HandScene hand_scene(const std::string& hand_file, const std::string& object_file) {
  HandScene out;
  out.hand = add_robot(out.world, read_robot("models/hands/" + hand_file, {}), {});
  out.object =
      out.world.add_body(read_body("models/objects/" + object_file, {}), BodyKind::object, {});
  return out;
}

}  // namespace clench::test
