#include "clench/model/build.h"

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "support/chains.h"
#include "support/listening.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

static WorldSpec arm_and_hand(double off) {
  WorldSpec spec;
  spec.bodies.push_back(
      {body_spec("flask", box(0.02, 0.02, 0.02)), Role::object, Pose::translation({0, 0, 5})});
  spec.robots.push_back({two_finger(), Pose{}, {0.5, 0}, {}});
  spec.robots.push_back({two_finger(), Pose{}, {}, {}});
  spec.order = {
      {WorldEntry::Kind::robot, 0}, {WorldEntry::Kind::body, 0}, {WorldEntry::Kind::robot, 1}};
  Connection c;
  c.link = 1;
  c.child = 1;
  c.X_LB = Pose::translation({0.1, 0, 0});
  // pose of the arm's last link, in a world without the connection
  World alone;
  const auto arm = alone.add_robot(spec.robots[0].robot, {});
  alone.set_dofs(arm, Eigen::Vector2d(0.5, 0));
  spec.robots[1].X_WB =
      alone.pose(link_of(alone.robot(arm), 0, 1)) * Pose::translation({0.1 + off, 0, 0});
  spec.connections.push_back(c);
  return spec;
}

TEST_CASE("bodies keep the order of the file") {
  const World world = build_world(arm_and_hand(0));
  CHECK(world.body(world.bodies()[0]).name == "gripper_base");
  CHECK(world.body(world.bodies()[5]).name == "flask");
  CHECK(world.body(world.bodies()[5]).kind == BodyKind::object);
  CHECK(world.robots().size() == 2);
}

TEST_CASE("a carried robot keeps its written pose if it agrees with the connection to six digits") {
  const WorldSpec spec = arm_and_hand(3e-6);
  std::vector<std::string> warnings;
  const World world =
      build_world(spec, Listening{.warn = [&](const std::string& w) { warnings.push_back(w); }});
  const Pose X = world.pose(world.robot(world.robots()[1]).base);
  CHECK((X.position - spec.robots[1].X_WB.position).norm() < 1e-15);
  CHECK(warnings.empty());
}

TEST_CASE("a connection that contradicts the pose takes precedence, with a warning") {
  std::vector<std::string> warnings;
  build_world(arm_and_hand(0.01),
              Listening{.warn = [&](const std::string& w) { warnings.push_back(w); }});
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "robot 'gripper_2': its pose and its connection to 'gripper' differ by 0.01 m and 0 rad; "
        "the connection is used");
}

TEST_CASE(
    "initial values outside the limits are moved to the limit, with a warning beyond six digits") {
  WorldSpec spec = arm_and_hand(0);
  spec.robots[1].dofs = {-4e-6, -0.1};
  std::vector<std::string> warnings;
  const World world =
      build_world(spec, Listening{.warn = [&](const std::string& w) { warnings.push_back(w); }});
  CHECK(world.dofs(world.robots()[1]) == Eigen::Vector2d(0, 0));
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "robot 'gripper_2': DOF 2 starts at -0.1, outside [0, 1.5707963267948966]; moved to the "
        "limit");
}

TEST_CASE("a moved initial value is reported to the receiver of repairs only") {
  WorldSpec spec = arm_and_hand(0);
  spec.robots[1].dofs = {0, 9};
  int ignored = 0, guessed = 0, repaired = 0;
  const auto count = [](int& n) { return [&n](const std::string&) { ++n; }; };
  build_world(spec,
              Listening{.warn = count(ignored), .note = count(guessed), .repair = count(repaired)});
  CHECK(ignored == 0);
  CHECK(guessed == 0);
  CHECK(repaired == 1);
}

TEST_CASE("breakaway states are restored") {
  WorldSpec spec = arm_and_hand(0);
  spec.connections.clear();
  spec.robots[1].robot = two_finger(DofKind::breakaway);
  spec.robots[1].dofs = {0.6, 0};
  spec.robots[1].joint_positions = {0.2, std::nullopt, std::nullopt, std::nullopt};
  const World world = build_world(spec);
  const auto hand = world.robots()[1];
  CHECK(world.joints(hand)[0] == 0.2);
  CHECK(world.joints(hand)[1] == doctest::Approx(0.3));
}

TEST_CASE(
    "a breakaway state that its DOF contradicts is dropped, and one outside the limits with a "
    "warning") {
  WorldSpec spec = arm_and_hand(0);
  spec.connections.clear();
  spec.robots[1].robot = two_finger(DofKind::breakaway);
  spec.robots[1].dofs = {0.6, 0.6};
  spec.robots[1].joint_positions = {0.9, -3.0, std::nullopt, 0.1};
  std::vector<std::string> warnings;
  const World world =
      build_world(spec, Listening{.warn = [&](const std::string& w) { warnings.push_back(w); }});
  const auto hand = world.robots()[1];
  CHECK(world.joints(hand)[0] == 0.6);
  CHECK(world.joints(hand)[1] == doctest::Approx(0.3));
  CHECK(world.joints(hand)[3] == 0.1);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "robot 'gripper_2': joint 2 of chain 1 broke away at -3, outside [0, 1.5707963267948966]; "
        "it follows its DOF");
}

TEST_CASE("wrong counts are rejected") {
  WorldSpec spec = arm_and_hand(0);
  spec.robots[1].dofs = {0};
  CHECK_THROWS_WITH_AS(build_world(spec), "robot 'gripper_2': expected 2 DOF values, got 1", Error);
  spec = arm_and_hand(0);
  spec.connections[0].child = 7;
  CHECK_THROWS_WITH_AS(build_world(spec), "a connection names robots 0 and 7, but the world has 2",
                       Error);
}

TEST_CASE("links that overlap when a robot is loaded are switched off, and reported as inferred") {
  RobotSpec spec = two_finger();
  // the second links overlap the base
  link_of(spec, 0, 1).body.shape = Shape::make(moved(box(0.4, 0.01, 0.01), {-0.025, 0, 0}));
  World world;
  std::vector<std::string> warnings;
  const auto id = add_robot(
      world, spec, {}, "", Listening{.note = [&](const std::string& w) { warnings.push_back(w); }});
  const Robot& robot = world.robot(id);
  CHECK_FALSE(world.may_collide(robot.base, link_of(robot, 0, 1)));
  CHECK(world.may_collide(robot.base, link_of(robot, 1, 1)));
  CHECK(colliding_pairs(world).empty());
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0] ==
        "robot 'gripper': these of its bodies overlap when it is loaded, and never collide from "
        "now on: "
        "gripper_base and "
        "gripper_chain0_link1");
}

TEST_CASE("messages about files show the beginning of long names") {
  WorldSpec spec = arm_and_hand(0.01);
  std::string word;
  for (int i = 0; i < 100; ++i) word += std::to_string(i);
  for (PlacedRobot& placed : spec.robots) {
    placed.robot.name = placed.robot.base.name = word;
    for (const int c : {0, 1}) link_of(placed.robot, c, 1).body.name = word;
    placed.dofs = {-1, 0};
  }
  std::vector<std::string> told;
  const auto listen = [&](const std::string& sentence) { told.push_back(sentence); };
  build_world(spec, Listening{.warn = listen, .note = listen});
  spec.robots[1].dofs = {0};
  try {
    build_world(spec);
  } catch (const Error& error) {
    told.emplace_back(error.what());
  }
  REQUIRE(told.size() == 4);
  for (const std::string& sentence : told) {
    CHECK(sentence.find(word.substr(0, max_excerpt) + "...") != std::string::npos);
    CHECK_MESSAGE(sentence.find(word.substr(0, max_excerpt + 1)) == std::string::npos, sentence);
  }
}
