#include "clench/model/describe_world.h"

#include "clench/base/random.h"
#include "clench/model/build.h"
#include "clench/model/compare_worlds.h"
#include "support/chains.h"
#include "support/listening.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

static Pose any_pose(Random& random) {
  Eigen::Vector4d q;
  Eigen::Vector3d p;
  for (double& x : q) x = random.uniform(-1, 1);
  for (double& x : p) x = random.uniform(-2, 2);
  return {Eigen::Quaterniond(q).normalized(), p};
}

/// Bodies and robots in random order, carried and renamed, some removed, with random values of
/// everything that can be set.
static World any_world(uint64_t seed) {
  Random random(9, seed);
  const auto chance = [&](double p) { return random.uniform(0, 1) < p; };
  World world;
  world.set_contact_threshold(random.uniform(1e-5, 1e-3));
  if (chance(0.7)) world.set_friction("cork", "wood", {0.9, 0.7});
  if (chance(0.5)) world.set_friction("felt", "cork", {1.1, 0.1});
  if (chance(0.5)) world.set_friction("glass", "metal", {0.25, 0.2});
  std::vector<Id<Robot>> robots;
  std::vector<Id<Body>> bodies;
  for (int i = 0; i < 6; ++i) {
    if (chance(0.5)) {
      const auto kind = chance(0.5) ? BodyKind::object : BodyKind::obstacle;
      bodies.push_back(
          world.add_body(body_spec("box", box(0.02, 0.03, 0.04)), kind, any_pose(random)));
    } else {
      const auto id = world.add_robot(two_finger(DofKind::breakaway), any_pose(random));
      world.set_dofs(id, Eigen::Vector2d(random.uniform(0, 1), random.uniform(0, 1)));
      auto broken = world.own_joint_positions(id);
      // behind the position of its DOF
      broken[0] = 0.5 * world.dofs(id)[0];
      world.set_dofs_unchecked(id, world.dofs(id), broken);
      if (!robots.empty() && chance(0.7)) {
        const BodySpec ring = body_spec("ring", box(0.01, 0.01, 0.01));
        world.mount(id, robots.back(), chance(0.5) ? 1 : 0, any_pose(random),
                    chance(0.5) ? &ring : nullptr);
      }
      robots.push_back(id);
    }
  }
  if (bodies.size() > 2) world.remove(bodies[1]);
  int number = 0;
  for (const auto id : world.bodies()) {
    if (chance(0.2)) world.set_name(id, "renamed " + std::to_string(++number));
    if (chance(0.3)) world.set_mass(id, random.uniform(0.1, 2));
    if (chance(0.3)) world.set_com(id, {random.uniform(0, 0.01), 0, 0.001});
    if (chance(0.2)) world.set_inertia(id, Eigen::Vector3d(1, 2, 2.5).asDiagonal());
    if (chance(0.2)) world.set_elastic_modulus(id, 1e6);
    if (chance(0.2)) world.set_soft_layer(id, 0.004);
    if (chance(0.2)) world.set_poisson_ratio(id, 0.3);
    if (chance(0.3)) world.set_material(id, "rubber");
    if (chance(0.1)) world.set_collision(false, id);
    for (const auto other : world.bodies())
      if (other != id && chance(0.05)) world.set_collision(chance(0.5), id, other);
  }
  if (chance(0.1)) world.set_collision(false);
  return world;
}

TEST_CASE("the description of any world builds a world of the same fingerprint") {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    INFO(seed);
    const World world = any_world(seed);
    std::vector<std::string> warnings;
    const World again =
        build_world(describe_world(world),
                    Listening{.warn = [&](const std::string& s) { warnings.push_back(s); }});
    CHECK(again.hash() == world.hash());
    CHECK(warnings.empty());
    CHECK(differences(world, again).empty());
  }
}

TEST_CASE("data outside the fingerprint are described too") {
  World world;
  BodySpec spec = body_spec("box", box(0.1, 0.1, 0.1));
  spec.file = "/models/box.iv";
  spec.tracker = 3;
  const auto id = world.add_body(spec, BodyKind::object, {});
  Appearance red;
  red.color = {1, 0, 0};
  world.set_appearance(id, red);
  world.set_camera(Camera{Pose::translation({1, 2, 3}), 0.7});
  const WorldSpec described = describe_world(world);
  CHECK(described.bodies[0].body.file == "/models/box.iv");
  CHECK(described.bodies[0].body.tracker == 3);
  CHECK(described.bodies[0].body.appearance.color == red.color);
  CHECK(described.camera->focal_distance == 0.7);
}

TEST_CASE("each difference of two worlds has its phrase") {
  World a;
  const auto cup = a.add_body(body_spec("cup", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  const auto hand = a.add_robot(two_finger(DofKind::breakaway), {});
  a.set_dofs(hand, Eigen::Vector2d(0.5, 0));
  const auto only = [&](auto change) {
    World b = a;
    change(b);
    return differences(a, b);
  };
  const auto phrase = [](const std::string& s) { return std::vector<std::string>{s}; };
  CHECK(only([](World&) {}).empty());
  CHECK(only([&](World& w) { w.set_name(cup, "mug"); }) == phrase("the name 'cup'"));
  CHECK(only([&](World& w) { w.set_mass(cup, 7); }) == phrase("the mass of 'cup'"));
  CHECK(only([&](World& w) {
          w.set_com(cup, {0, 0, 0.1});
        }) == std::vector<std::string>{"the center of mass of 'cup'", "the inertia of 'cup'"});
  CHECK(only([&](World& w) { w.set_inertia(cup, Eigen::Matrix3d::Identity()); }) ==
        phrase("the inertia of 'cup'"));
  CHECK(only([&](World& w) { w.set_material(cup, "glass"); }) == phrase("the material of 'cup'"));
  CHECK(only([&](World& w) { w.set_elastic_modulus(cup, 2e6); }) ==
        phrase("the elastic modulus of 'cup'"));
  CHECK(only([&](World& w) { w.set_soft_layer(cup, 0.005); }) == phrase("the soft layer of 'cup'"));
  CHECK(only([&](World& w) { w.set_poisson_ratio(cup, 0.3); }) ==
        phrase("Poisson's ratio of 'cup'"));
  CHECK(only([&](World& w) { w.set_appearance(cup, {}); }).empty());
  CHECK(only([&](World& w) {
          w.set_pose(cup, Pose::translation({0, 0, 1e-11}));
        }) == phrase("the pose of 'cup'"));
  CHECK(only([&](World& w) {
          w.set_friction("glass", "wood", {0.5, 0.4});
        }) == phrase("the friction of wood on glass"));
  CHECK(only([&](World& w) { w.set_contact_threshold(2e-4); }) == phrase("the contact threshold"));
  CHECK(only([&](World& w) { w.set_collision(false, cup); }) == phrase("which bodies may collide"));
  CHECK(only([&](World& w) { w.set_collision(false); }) == phrase("which bodies may collide"));
  CHECK(only([&](World& w) {
          auto broken = w.own_joint_positions(hand);
          broken[0] = 0.5;
          w.set_dofs_unchecked(hand, w.dofs(hand), broken);
        }) == phrase("the joints of 'gripper' that do not follow their DOFs"));
  CHECK(only([&](World& w) { w.remove(cup); }) == phrase("its number of bodies"));
}

TEST_CASE("collision rules of a robot's file are switches of the world") {
  RobotSpec spec = two_finger();
  spec.collision_rules.parts_off = {1};
  spec.collision_rules.pairs_off = {{-1, 3}};
  World world;
  const Robot& robot = world.robot(world.add_robot(spec, {}));
  const auto cup = world.add_body(body_spec("cup", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  CHECK_FALSE(world.may_collide(link_of(robot, 0, 1), cup));
  CHECK_FALSE(world.may_collide(robot.base, link_of(robot, 1, 1)));
  CHECK(world.may_collide(link_of(robot, 1, 1), cup));
}

TEST_CASE("parts closer than the contact threshold are switched off if the robot requests it") {
  // the outer links of straight fingers are 50 um apart
  RobotSpec spec = two_finger();
  for (const int c : {0, 1}) joint_of(spec, c, 0).X_PJ.position.x() *= (0.005 + 0.000025) / 0.03;
  for (const bool near : {false, true}) {
    spec.collision_rules.near_pairs_off = near;
    World world;
    const Robot& robot = world.robot(add_robot(world, spec, {}));
    CHECK(world.may_collide(link_of(robot, 0, 1), link_of(robot, 1, 1)) != near);
  }
}
