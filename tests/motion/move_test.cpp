#include "clench/motion/move.h"

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

static Id<Body> add(World& world, const std::string& name, Mesh mesh, const Eigen::Vector3d& at) {
  return world.add_body(body_spec(name, std::move(mesh)), BodyKind::object, Pose::translation(at));
}

TEST_CASE("a falling box stops on the table after a fall of any length") {
  for (const double height : {0.011, 0.5, 1000.0}) {
    World world;
    add(world, "table", moved(box(1, 1, 0.1), {0, 0, -0.05}), {0, 0, 0});
    const auto block = add(world, "block", box(0.02, 0.02, 0.02), {0, 0, height});
    const auto result = move_body(world, block, Pose::translation({0, 0, -height}));
    const double gap = world.pose(block).position.z() - 0.01;
    CHECK(result.touched);
    REQUIRE(result.stopped_by.size() == 1);
    CHECK(gap > 0);
    CHECK(gap <= world.contact_threshold());
    CHECK(result.queries < 60);
  }
}

TEST_CASE("a rotating bullet does not tunnel through a sheet") {
  World world;
  add(world, "sheet", box(1, 1, 1e-5), {0, 0, 0});
  const auto bullet = add(world, "bullet", box(0.001, 0.001, 0.003), {0, 0, 1});
  const Pose target{Eigen::Quaterniond(Eigen::AngleAxisd(3, Eigen::Vector3d::UnitX())), {0, 0, -1}};
  const auto result = move_body(world, bullet, target);
  CHECK(result.touched);
  CHECK(world.pose(bullet).position.z() > 0);
}

TEST_CASE("a free path is traversed to its exact end") {
  World world;
  const auto block = add(world, "block", box(0.02, 0.02, 0.02), {0, 0, 0});
  add(world, "far", box(0.02, 0.02, 0.02), {0, 1, 0});
  const Pose target{Eigen::Quaterniond(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ())),
                    {0.1, 0.2, 0.3}};
  const auto result = move_body(world, block, target);
  CHECK(result.fraction == 1);
  CHECK_FALSE(result.touched);
  CHECK(world.pose(block) == target);
}

TEST_CASE("a body in contact may slide and separate, but not be pushed in") {
  World world;
  add(world, "table", moved(box(1, 1, 0.1), {0, 0, -0.05}), {0, 0, 0});
  const auto block = add(world, "block", box(0.02, 0.02, 0.02), {0, 0, 0.01 + 5e-5});
  const Pose start = world.pose(block);
  const auto pushed = move_body(world, block, Pose::translation({0, 0, 0}));
  CHECK(pushed.touched);
  CHECK(pushed.fraction == 0);
  CHECK(world.pose(block) == start);
  const Pose aside = Pose::translation({0.01, 0, start.position.z()});
  CHECK(move_body(world, block, aside).fraction == 1);
  const Pose up = Pose::translation({0.01, 0, 0.3});
  CHECK(move_body(world, block, up).fraction == 1);
}

TEST_CASE(
    "no random motion through a heap penetrates a body, and each stop is within the threshold") {
  World world;
  add(world, "ball", ball(0.03), {0, 0, 0});
  add(world, "box", box(0.05, 0.03, 0.02), {0.06, 0, 0});
  const auto flyer = add(world, "flyer", box(0.01, 0.02, 0.03), {1, 1, 1});
  Random random(5);
  int stops = 0;
  for (int i = 0; i < 60; ++i) {
    const auto vector = [&](double r) {
      return Eigen::Vector3d(random.uniform(-r, r), random.uniform(-r, r), random.uniform(-r, r));
    };
    const auto turn = [&] {
      return Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0, 3), vector(1).normalized()));
    };
    const Pose start{turn(), vector(1).normalized() * 0.2};
    const Pose target{turn(), -start.position + vector(0.05)};
    world.set_pose(flyer, start);
    const auto result = move_body(world, flyer, target);
    CHECK(colliding_pairs(world).empty());
    // slow reference: at no earlier instant of the path is the gap within the threshold, sampled a
    // thousand times
    const double t = result.fraction;
    double least = 1;
    const auto own = std::array{flyer};
    for (int k = 0; k < 200; ++k) {
      world.set_pose(flyer, interpolate(start, target, t * k / 200.0));
      for (const auto other : world.bodies())
        if (other != flyer)
          least = std::min(least, distance(world, own, std::array{other}).distance);
    }
    CHECK(least > world.contact_threshold() * 0.24);
    stops += result.touched;
  }
  CHECK(stops > 20);
}

TEST_CASE("a hand approaches along its direction until contact") {
  World world;
  const auto hand = world.add_robot(two_finger(), {});
  add(world, "wall", box(1, 0.1, 1), {0, 0.5, 0});
  const auto result = approach(world, hand, 2);
  CHECK(result.touched);
  const double tip = world.pose(world.robot(hand).base).position.y() + 0.1 - 0.003;
  CHECK(tip < 0.45);
  CHECK(tip >= 0.45 - world.contact_threshold());
  CHECK(approach(world, hand, 1).fraction == 0);
}

TEST_CASE("the base of a carried robot cannot be moved") {
  World world;
  const auto arm = world.add_robot(two_finger(), {}), hand = world.add_robot(two_finger(), {});
  world.mount(hand, arm, 0, Pose::translation({0.2, 0, 0}));
  CHECK_THROWS_WITH_AS(move_robot(world, hand, Pose{}),
                       "robot 'gripper_2' is carried by 'gripper': move that one", Error);
}

TEST_CASE("a move that starts in collision is an error that names the pair") {
  World world;
  const auto a = add(world, "a", box(0.02, 0.02, 0.02), {0, 0, 0});
  add(world, "b", box(0.02, 0.02, 0.02), {0.01, 0, 0});
  CHECK_THROWS_WITH_AS(move_body(world, a, Pose{}),
                       "moving 'a': the motion starts in collision: a and b", Error);
}

TEST_CASE("if rounding exceeds the threshold nothing is moved") {
  World world;
  world.set_contact_threshold(1e-9);
  const auto block = add(world, "block", box(0.02, 0.02, 0.02), {1e6, 0, 0});
  add(world, "other", box(0.02, 0.02, 0.02), {1e6, 1, 0});
  CHECK_THROWS_WITH_AS(move_body(world, block, Pose::translation({1e6, 2, 0})),
                       "moving near 'block': 1000000 m from the origin, a contact threshold of "
                       "1e-09 m is lost in rounding",
                       Error);
}

TEST_CASE("invalid arguments of a move are rejected") {
  World world;
  const auto hand = world.add_robot(two_finger(), {});
  CHECK_THROWS_WITH_AS(approach(world, hand, -1),
                       "approach of 'gripper': the reach must be >= 0 [m], got -1", Error);
  const auto a = add(world, "a", box(0.02, 0.02, 0.02), {1, 0, 0});
  CHECK_THROWS_WITH_AS(
      move_body(world, a, Pose::translation({NAN, 0, 0})),
      "body 'a': expected a position within 1e+09 m of the origin, got (nan, 0, 0)", Error);
}

TEST_CASE("a body that overlaps its support within the threshold slides and separates") {
  for (const double overlap : {0.0, 1e-17, 2e-5, 0.9e-4}) {
    World world;
    add(world, "table", moved(box(1, 1, 0.1), {0, 0, -0.05}), {0, 0, 0});
    const auto block = add(world, "block", box(0.02, 0.02, 0.02), {0, 0, 0.01 - overlap});
    const Pose start = world.pose(block);
    const auto slid = move_body(world, block, Pose::translation({0.1, 0, start.position.z()}));
    CHECK(slid.fraction == 1);
    CHECK(world.pose(block).position.x() == 0.1);
    const double gap = world.pose(block).position.z() - 0.01;
    CHECK(gap > 0);
    CHECK(gap <= 1.25 * world.contact_threshold() - overlap + 1e-12);
    world.set_pose(block, start);
    const Pose above = Pose::translation({0, 0, 0.2});
    CHECK(move_body(world, block, above).fraction == 1);
    CHECK(world.pose(block) == above);
    world.set_pose(block, start);
    CHECK(move_body(world, block, Pose::translation({0, 0, -0.2})).fraction == 0);
  }
}

TEST_CASE("a body that overlaps a wall, or its support by more than the threshold, may not move") {
  World world;
  add(world, "table", moved(box(1, 1, 0.1), {0, 0, -0.05}), {0, 0, 0});
  const auto block = add(world, "block", box(0.02, 0.02, 0.02), {0, 0, 0.01 - 1.3e-4});
  const Pose above = Pose::translation({0, 0, 0.2});
  CHECK_THROWS_WITH_AS(move_body(world, block, above),
                       "moving 'block': the motion starts in collision: block and table", Error);
  add(world, "wall", box(0.02, 1, 1), {0.02 - 1e-5, 0, 0.6});
  world.set_pose(block, Pose::translation({0, 0, 0.3}));
  const Pose start = world.pose(block);
  CHECK_THROWS_WITH_AS(move_body(world, block, above),
                       "moving 'block': the motion starts in collision: block and wall", Error);
  CHECK(world.pose(block) == start);
}
