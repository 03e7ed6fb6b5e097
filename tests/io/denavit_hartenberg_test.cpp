#include "io/denavit_hartenberg.h"

#include <numbers>

#include "robot_compare.h"
#include "support/meshes.h"

using namespace clench;
using Eigen::Vector3d;
using std::numbers::pi;

static Pose made_of(const CommonNormal& n) {
  return dh_pose(n.theta, n.d, n.a, n.alpha) * dh_pose(n.phi, n.h, 0, 0);
}

static double difference(const Pose& a, const Pose& b) {
  return std::max((a.inverse() * b).angle(), (a.position - b.position).norm());
}

TEST_CASE("two frames are as far apart as their axes' common normal and the ways to it say") {
  Random random(1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Pose X = test::random_pose(random, 0.5);
    // a lean of 0.01 rad, of which few frames have less, makes 100 times a rounding of 1 m
    CHECK(difference(made_of(common_normal(X)), X) < 1e-13);
  }
}

TEST_CASE("parallel, meeting and coincident axes have common normals, too") {
  const Pose along = Pose::translation({0.03, 0.04, 0.7});
  for (const double turn : {0.0, 0.3, pi})
    for (const bool over : {false, true}) {
      Pose X = along * Pose::turn(over ? pi : 0, Vector3d::UnitX()) *
               Pose::turn(turn, Vector3d::UnitZ());
      CommonNormal n = common_normal(X);
      CHECK(difference(made_of(n), X) < 1e-15);
      CHECK(n.h == 0);
      CHECK(std::abs(n.a) == doctest::Approx(0.05));
      X.position = {0, 0, 0.7};
      n = common_normal(X);
      CHECK(difference(made_of(n), X) < 1e-15);
      CHECK(n.a == 0);
      CHECK(n.theta == 0);
    }
  const Pose meeting = dh_pose(0.4, 0.1, 0, 0.9) * dh_pose(-0.7, 0.2, 0, 0);
  const CommonNormal n = common_normal(meeting);
  CHECK(n.a == 0);
  CHECK(n.theta == doctest::Approx(0.4));
  CHECK(n.d == doctest::Approx(0.1));
  CHECK(n.alpha == doctest::Approx(0.9));
  CHECK(n.phi == doctest::Approx(-0.7));
  CHECK(n.h == doctest::Approx(0.2));
}

TEST_CASE("axes that rounding leans count as parallel, and those that a file leans do not") {
  const auto leaning = [](double lean) {
    return Pose::translation({0.05, 0.02, 0}) * Pose::turn(lean, Vector3d::UnitY());
  };
  const CommonNormal rounded = common_normal(leaning(1e-15));
  CHECK(rounded.h == 0);
  CHECK(difference(made_of(rounded), leaning(1e-15)) < 2e-15);
  // 1.5708 for a quarter turn; the normal is 5 km away, whose rounding is 1e-12
  const CommonNormal far = common_normal(leaning(3.7e-6));
  CHECK(std::abs(far.h) > 5000);
  CHECK(difference(made_of(far), leaning(3.7e-6)) < 1e-11);
}

/// Joints that stand anywhere, some after Denavit and Hartenberg; links between, some beside their
/// frames.
static RobotSpec any_robot(uint64_t seed) {
  Random random(2, seed);
  RobotSpec robot;
  robot.name = "any";
  ChainSpec chain;
  chain.X_BC = test::random_pose(random, 0.5);
  for (int j = 0; j < 6; ++j) {
    DofSpec dof;
    robot.dofs.push_back(dof);
    JointSpec joint;
    joint.dof = j;
    joint.kind = random.uniform(0, 1) < 0.3 ? JointKind::prismatic : JointKind::revolute;
    joint.ratio = random.uniform(-2, 2);
    joint.theta = random.uniform(-3, 3);
    joint.d = random.uniform(-0.1, 0.1);
    joint.a = random.uniform(-0.1, 0.1);
    joint.alpha = random.uniform(-3, 3);
    joint.min = random.uniform(-1, 0);
    joint.max = random.uniform(0, 1);
    if (random.uniform(0, 1) < 0.6) {
      joint.placed_freely = true;
      joint.X_before = test::random_pose(random, 0.5);
      joint.X_after = test::random_pose(random, 0.5);
    }
    chain.joints.push_back(joint);
  }
  for (int l = -1; l < 6; ++l) {
    LinkSpec link;
    link.last_joint = l;
    link.body.name = "any_link" + std::to_string(l + 1);
    link.body.com = Vector3d(random.uniform(-1, 1), 0, 0);
    if (l % 2) link.X_JL = test::random_pose(random, 0.5);
    chain.links.push_back(link);
  }
  robot.chains.push_back(chain);
  return robot;
}

TEST_CASE("a chain of joints placed freely has the same link poses after Denavit and Hartenberg") {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const RobotSpec robot = any_robot(seed);
    const DhChain dh = denavit_hartenberg(robot.chains[0], robot.chains[0].X_BC);
    RobotSpec ours = robot;
    ours.chains[0].X_BC = dh.X_BC;
    ours.chains[0].joints = dh.joints;
    for (size_t l = 0; l < dh.X_JL.size(); ++l) ours.chains[0].links[l].X_JL = dh.X_JL[l];
    for (const JointSpec& joint : dh.joints) {
      CHECK(joint.X_before == Pose{});
      CHECK(joint.X_after == Pose{});
    }
    Random random(3, seed);
    for (int k = 0; k < 10; ++k) {
      const auto dofs = test::any_dofs(robot, random);
      const auto a = test::link_poses(robot, dofs)[0], b = test::link_poses(ours, dofs)[0];
      for (size_t l = 0; l < a.size(); ++l) CHECK(difference(a[l], b[l]) < 1e-12);
    }
  }
}

TEST_CASE("a chain after Denavit and Hartenberg already is kept to the bit") {
  RobotSpec robot = any_robot(1);
  for (JointSpec& joint : robot.chains[0].joints) joint.X_before = joint.X_after = Pose{};
  const DhChain dh = denavit_hartenberg(robot.chains[0], robot.chains[0].X_BC);
  CHECK(dh.X_BC == robot.chains[0].X_BC);
  for (size_t j = 0; j < dh.joints.size(); ++j)
    test::check_equal(dh.joints[j], robot.chains[0].joints[j]);
  for (size_t l = 0; l < dh.X_JL.size(); ++l)
    CHECK(dh.X_JL[l] == robot.chains[0].links[l].X_JL.value_or(Pose{}));
}
