#include "clench/grasp/measure/clearance.h"

#include <doctest/doctest.h>

#include "support/robots.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

namespace {

struct HandAndCube {
  World world;
  Id<Robot> hand;
  Id<Body> object;
};

// a two-fingered hand at the origin and a cube far above it
HandAndCube hand_and_cube() {
  HandAndCube place;
  place.hand = place.world.add_robot(two_finger(), {});
  place.object = place.world.add_body(body_spec("cube", box(0.1, 0.1, 0.1)), BodyKind::object,
                                      Pose::translation({0, 0, 5}));
  return place;
}

}  // namespace

TEST_CASE("clearance is the distance to the nearest body that is not grasped") {
  HandAndCube p = hand_and_cube();
  CHECK(clearance(p.world, p.hand, p.object) == std::numeric_limits<double>::infinity());
  const auto wall = p.world.add_body(body_spec("wall", box(1, 1, 1)), BodyKind::obstacle,
                                     Pose::translation({0, 0, -3}));
  const double alone = clearance(p.world, p.hand, p.object);
  const auto parts = p.world.bodies_of(p.hand);
  CHECK(alone == distance(p.world, parts, std::span(&wall, 1)).distance);
  // another object counts, at any distance
  const auto other = p.world.add_body(body_spec("other", box(1, 1, 1)), BodyKind::object,
                                      Pose::translation({0, 0, -2}));
  CHECK(clearance(p.world, p.hand, p.object) == doctest::Approx(alone - 1));
  CHECK(clearance(p.world, p.hand, other) == alone);
  p.world.set_pose(wall, {});
  CHECK(clearance(p.world, p.hand, p.object) == 0);
}

TEST_CASE("penetration is the depth of the deepest point of the hand in the object") {
  HandAndCube p = hand_and_cube();
  CHECK(penetration(p.world, p.hand, p.object) == 0);
  // from below into the hand's base, with its corners inside the cube's outline
  const Body& base = p.world.body(p.world.robot(p.hand).base);
  const double low = base.shape->bounds().low.y();
  for (const double depth : {0.001, 0.004, 0.009}) {
    p.world.set_pose(p.object, Pose::translation({0, low - 0.05 + depth, 0}));
    CHECK(penetration(p.world, p.hand, p.object) == doctest::Approx(depth).epsilon(1e-9));
  }
}

TEST_CASE("penetration detects overlaps without inner corners, and pairs that are switched off") {
  HandAndCube p = hand_and_cube();
  const Id<Body> base = p.world.robot(p.hand).base;
  const Bounds box_B = p.world.body(base).shape->bounds();
  // a plate across the hand's base
  const double thickness = box_B.size().minCoeff() / 4;
  const auto plate = p.world.add_body(body_spec("plate", box(10, 10, thickness)), BodyKind::object,
                                      p.world.pose(base) * Pose::translation(box_B.center()));
  CHECK(penetration(p.world, p.hand, plate) == doctest::Approx(thickness / 2).epsilon(2e-3));
  p.world.set_collision(false, base, plate);
  CHECK(penetration(p.world, p.hand, plate) == doctest::Approx(thickness / 2).epsilon(2e-3));
  CHECK(penetration(p.world, p.hand, p.object) == 0);
}
