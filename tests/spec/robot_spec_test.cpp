#include "clench/spec/check_robot.h"

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/base/text.h"
#include "support/chains.h"

using namespace clench;
using namespace clench::test;

static RobotSpec two_joints() {
  RobotSpec robot;
  robot.name = "arm";
  robot.dofs.resize(1);
  robot.links.resize(1);
  robot.links[0].body.name = "fist";
  robot.links[0].joints = {{.dof = 0, .ratio = 1, .min = -1, .max = 2},
                           {.dof = 0, .ratio = -0.5, .min = -0.5, .max = 1}};
  return robot;
}

TEST_CASE(
    "the approach frame is right-handed, with z along the direction and its origin at the point") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d direction(random.normal(), random.normal(), random.normal()),
        point(1, 2, 3);
    const Pose X_BA = approach_frame(point, direction);
    const Eigen::Matrix3d R = X_BA.matrix();
    CHECK((R.col(2) - direction.normalized()).norm() < 1e-14);  // rounding of a few products
    CHECK((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK(R.determinant() == doctest::Approx(1));
    CHECK(X_BA.position == point);
    // y is perpendicular to z and the x (or y) axis of the base
    const Eigen::Vector3d x0 =
        std::abs(R(0, 2)) > 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
    CHECK(std::abs(R.col(1).dot(x0)) < 1e-14);
  }
  CHECK(approach_frame({0, 0, 0}, {0, 0, 5}).angle() < 1e-15);
}

TEST_CASE("an approach without direction is rejected") {
  CHECK_THROWS_WITH_AS(approach_frame({0, 0, 0}, {0, 0, 0}),
                       "approach direction: expected a direction, got (0, 0, 0)", Error);
  CHECK_THROWS_AS(approach_frame({0, 0, 0}, {NAN, 0, 1}), Error);
  CHECK_THROWS_AS(approach_frame({INFINITY, 0, 0}, {0, 0, 1}), Error);
}

TEST_CASE("a DOF's range is the intersection of the ranges of its joints") {
  const auto [low, high] = dof_range(two_joints(), 0);
  CHECK(low == -1);  // the first joint: [-1, 2]; the second: [-2, 1], swapped by its ratio
  CHECK(high == 1);
  CHECK(dof_range(two_joints(), 5) == std::array<double, 2>{0, 0});
}

TEST_CASE("faults of a robot are reported with their place") {
  const auto refused = [](auto change, const char* sentence) {
    RobotSpec robot = two_joints();
    change(robot);
    CHECK_THROWS_WITH_AS(check_robot(robot), sentence, Error);
  };
  CHECK_NOTHROW(check_robot(two_joints()));
  refused([](RobotSpec& r) { joint_of(r, 0, 1).dof = 1; },
          "arm: link 'fist': joint 1: expected a DOF from 0 to 0, got 1");
  refused([](RobotSpec& r) { joint_of(r, 0, 1).dof = -1; },
          "arm: link 'fist': joint 1: expected a DOF from 0 to 0, got -1");
  refused([](RobotSpec& r) { joint_of(r, 0, 0).ratio = 0; },
          "arm: link 'fist': joint 0: expected a ratio other than 0, got 0");
  refused([](RobotSpec& r) { joint_of(r, 0, 0).ratio = 1e-309; },
          "arm: link 'fist': joint 0: ratio: expected a number from 1e-30 to 1e+30, got 1e-309");
  refused(
      [](RobotSpec& r) { joint_of(r, 0, 1).max = INFINITY; },
      "arm: link 'fist': joint 1: max: expected a number from -1e+30 to 1e+30 [rad or m], got inf");
  refused([](RobotSpec& r) { joint_of(r, 0, 0).axis.z() = 2; },
          "arm: link 'fist': joint 0: expected an axis of length 1, got (0, 0, 2)");
  refused([](RobotSpec& r) { joint_of(r, 0, 1).axis.x() = NAN; },
          "arm: link 'fist': joint 1: expected an axis of length 1, got (nan, 0, 1)");
  refused([](RobotSpec& r) { joint_of(r, 0, 1).X_PJ.position.x() = NAN; },
          "arm: link 'fist': joint 1: expected a position within 1e+09 m of the origin, got (nan, "
          "0, 0)");
  refused([](RobotSpec& r) { joint_of(r, 0, 0).min = 3; },
          "arm: link 'fist': joint 0: min 3 exceeds max 2 [rad]");
  refused(
      [](RobotSpec& r) {
        joint_of(r, 0, 0).kind = JointKind::prismatic, joint_of(r, 0, 0).min = 3;
      },
      "arm: link 'fist': joint 0: min 3 exceeds max 2 [m]");
  refused([](RobotSpec& r) { joint_of(r, 0, 0).spring = -1; },
          "arm: link 'fist': joint 0: spring: expected a number from 0 to 1e+30, got -1");
  for (const int parent : {-2, 0, 1})
    refused([=](RobotSpec& r) { r.links[0].parent = parent; },
            fmt::format("arm: link 'fist': expected a parent from -1, the base, to -1, a link "
                        "before it, got {}",
                        parent)
                .c_str());
  refused([](RobotSpec& r) { r.links[0].X_JL.position.x() = INFINITY; },
          "arm: link 'fist': expected a position within 1e+09 m of the origin, got (inf, 0, 0)");
  refused([](RobotSpec& r) { r.collision_rules.parts_off = {1}; },
          "arm: collision rule: expected one of 1 links, or -1 for the base, got 1");
  refused([](RobotSpec& r) { r.dofs[0].kp = NAN; },
          "arm: DOF 0: Kp: expected a number from -1e+30 to 1e+30, got nan");
  refused([](RobotSpec& r) { r.dofs[0].default_velocity = -1e31; },
          "arm: DOF 0: default velocity: expected a number from -1e+30 to 1e+30, got -1e+31");
  refused([](RobotSpec& r) { r.base.mass = 1e31; },
          "arm: base '': mass: expected a number from 1e-12 to 1e+12 [kg], got 1e+31");
  refused([](RobotSpec& r) { r.dofs[0].max_effort = -1; },
          "arm: DOF 0: max effort: expected a number from 0 to 1e+30, got -1");
  refused([](RobotSpec& r) { r.dofs[0].breakaway_torque = -1; },
          "arm: DOF 0: breakaway torque: expected a number from 0 to 1e+30, got -1");
  refused([](RobotSpec& r) { joint_of(r, 0, 1).min = 0.9, joint_of(r, 0, 0).min = 1.5; },
          "arm: DOF 0: expected a range that all of its joints allow, got from 1.5 to -1.8");
}

TEST_CASE("messages show the beginning of a robot's long name") {
  std::string word;
  for (int n = 0; n < 100; ++n) word += std::to_string(n);
  const auto cut = [&](auto change) {
    RobotSpec robot = two_joints();
    robot.name = word;
    change(robot);
    try {
      check_robot(robot);
    } catch (const Error& error) {
      CHECK_MESSAGE(std::string(error.what()).starts_with(word.substr(0, max_excerpt) + "...: "),
                    error.what());
      return;
    }
    CHECK_MESSAGE(false, "nothing was wrong");
  };
  cut([](RobotSpec& r) { r.dofs[0].kp = NAN; });
  cut([](RobotSpec& r) { joint_of(r, 0, 0).ratio = 0; });
  cut([](RobotSpec& r) { r.links[0].parent = 3; });
  cut([](RobotSpec& r) { r.base.mass = 0; });
  cut([](RobotSpec& r) { r.tactile.push_back({.link = 5}); });
  cut([&](RobotSpec& r) { r.tendons.emplace_back().stiffness = -1; });
}
