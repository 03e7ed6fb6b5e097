// Bits that exclude collisions, instead of lists of pairs.
#include "clench/base/error.h"
#include "clench/model/build.h"
#include "clench/model/compare_worlds.h"
#include "clench/model/describe_world.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

World boxes(int count) {
  World world;
  for (int i = 0; i < count; ++i)
    world.add_body(body_spec("box", box(0.1, 0.1, 0.1)), BodyKind::object,
                   Pose::translation({0.05 * i, 0, 0}));
  return world;
}

}  // namespace

TEST_CASE("bodies collide according to their bits, and single pairs as set by a script") {
  World world = boxes(5);
  const auto id = world.bodies();
  world.set_collision_bits(id[0], {.stands = true});
  world.set_collision_bits(id[1], {.stands = true});
  world.set_collision_bits(id[2], {.type = 2, .affinity = 4});
  world.set_collision_bits(id[3], {.type = 4, .affinity = 1});
  const World before = world;
  CHECK_FALSE(world.may_collide(id[0], id[1]));
  CHECK_FALSE(world.may_collide(id[0], id[2]));
  CHECK(world.may_collide(id[0], id[3]));
  CHECK(world.may_collide(id[2], id[3]));
  CHECK(world.may_collide(id[2], id[4]));
  using Pairs = std::vector<BodyPair>;
  CHECK(world.pairs_off() == Pairs{{id[0], id[1]}, {id[0], id[2]}, {id[1], id[2]}});
  // one pair is switched on, and the others stay off
  world.set_collision(true, id[1], id[0]);
  CHECK(world.may_collide(id[0], id[1]));
  CHECK(world.pairs_off() == Pairs{{id[0], id[2]}, {id[1], id[2]}});
  world.set_collision(false, id[0], id[1]);
  CHECK(world.pairs_off() == before.pairs_off());
  CHECK(differences(world, before).empty());
  // a pair that is switched on collides; other pairs are unaffected
  world.set_collision(true, id[0], id[2]);
  CHECK(world.may_collide(id[2], id[0]));
  CHECK_FALSE(world.may_collide(id[1], id[2]));
  world.set_collision(false, id[0], id[2]);
  CHECK(before.hash() != boxes(5).hash());
  // a removed body is in no pair
  world.remove(id[2]);
  CHECK(world.pairs_off() == Pairs{{id[0], id[1]}});
}

TEST_CASE("a world with bits is described by them, and built again") {
  World world = boxes(4);
  const auto id = world.bodies();
  for (const auto body : id) world.set_collision_bits(body, {.type = 2, .stands = true});
  world.set_collision(true, id[1], id[2]);
  const World again = build_world(describe_world(world));
  CHECK(again.pairs_off().size() == 5);
  CHECK(again.settings().pairs_off.empty());
  CHECK(again.may_collide(again.bodies()[2], again.bodies()[1]));
  CHECK(differences(world, again).empty());
  CHECK(world.hash() == again.hash());
}

TEST_CASE("worlds with the same colliding pairs are equal, by bits or by lists of pairs") {
  World bits = boxes(3), pairs = boxes(3);
  for (const auto id : bits.bodies()) bits.set_collision_bits(id, {.stands = true});
  const auto id = pairs.bodies();
  for (int i = 0; i < 3; ++i) pairs.set_collision(false, id[i], id[(i + 1) % 3]);
  CHECK(differences(bits, pairs).empty());
  pairs.set_collision(true, id[0], id[1]);
  CHECK(differences(bits, pairs) == std::vector<std::string>{"which bodies may collide"});
}

TEST_CASE("thousands of bodies that never collide take little memory, and are not listed") {
  World world = boxes(2);
  const size_t one = world.bytes();
  for (int i = 0; i < 2100; ++i)
    world.set_collision_bits(
        world.add_body(body_spec("b", box(0.1, 0.1, 0.1)), BodyKind::obstacle, {}),
        {.stands = true});
  CHECK(world.bytes() < one + 2100 * 4000);
  CHECK(colliding_pairs(world, world.bodies(), world.bodies(), &world.context()).size() ==
        1 + 2 * 2100);
  CHECK_THROWS_WITH_AS(world.pairs_off(),
                       "world: expected at most 2000000 pairs of bodies that never collide", Error);
}
