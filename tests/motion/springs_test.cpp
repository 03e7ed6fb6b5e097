#include "clench/motion/springs.h"

#include <array>
#include <random>

#include "clench/motion/drive.h"
#include "support/cases.h"
#include "support/chains.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

using std::numbers::pi;

// two fingers whose joints are held by springs only, and an object between them, optionally without
// friction
struct SpringBench {
  World world;
  Id<Robot> hand;
  Id<Body> object;

  SpringBench(std::array<double, 2> springs, const std::string& material, Eigen::Vector3d at,
              Mesh mesh = ball(0.015)) {
    RobotSpec spec = two_finger(DofKind::compliant, 0.5);
    for (const int c : {0, 1})
      for (const int j : {0, 1}) joint_of(spec, c, j).spring = springs[j];
    hand = world.add_robot(spec, {});
    BodySpec body = body_spec("object", std::move(mesh));
    body.material = material;
    object = world.add_body(body, BodyKind::object, Pose::translation(at));
  }
  const Robot& robot() const { return world.robot(hand); }
  Eigen::VectorXd dofs() const { return world.dofs(hand); }
  JointPosition own_position(int chain, int joint) const {
    return world.own_joint_positions(hand)[joint_number(robot(), chain, joint)];
  }
  double q(int chain, int joint) const {
    return world.joints(hand)[joint_number(robot(), chain, joint)];
  }
  std::vector<Contact> touching() const {
    return contacts(world, world.bodies(), world.bodies_of(hand));
  }
  double unrest() const {
    double most = 0;
    for (const double x :
         SpringBalance(world, hand, CarriedBodies(world, hand), touching()).displacement())
      most = std::max(most, std::abs(x));
    return most;
  }
};

// energy stored in the springs of a finger, with its tendon at q
double energy(const Robot& robot, int chain, double q, double first, double second) {
  const Joint &inner = joint_of(robot, chain, 0), &outer = joint_of(robot, chain, 1);
  const double a = inner.ratio * q - first, b = outer.ratio * q - second;
  return 0.5 * (inner.spring * a * a + outer.spring * b * b);
}

// The least energy of a finger over nearby postures without collision: brute-force reference.
double min_energy_nearby(const SpringBench& bench, int chain, double q, double reach) {
  World world = bench.world;
  const int cells = 100;
  double best = std::numeric_limits<double>::infinity();
  std::vector<JointPosition> own = {bench.q(0, 0), bench.q(0, 1), bench.q(1, 0), bench.q(1, 1)};
  const std::vector<Id<Body>> finger = {link_of(bench.robot(), chain, 0),
                                        link_of(bench.robot(), chain, 1)};
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      const double first =
          std::clamp(bench.q(chain, 0) + reach * (2.0 * i / cells - 1), 0.0, pi / 2);
      const double second =
          std::clamp(bench.q(chain, 1) + reach * (2.0 * j / cells - 1), 0.0, pi / 2);
      const double e = energy(bench.robot(), chain, q, first, second);
      if (e >= best) continue;
      own[2 * chain] = first, own[2 * chain + 1] = second;
      world.set_dofs_unchecked(bench.hand, world.dofs(bench.hand), own);
      if (colliding_pairs(world, finger, world.bodies()).empty()) best = e;
    }
  return best;
}

}  // namespace

TEST_CASE("without friction a finger comes to rest at the minimum of its springs' energy") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> x(-0.01, 0.01), y(0.03, 0.09), k(0.2, 5);
  for (int run = 0; run < cases(30); ++run) {
    SpringBench bench({k(random), k(random)}, "frictionless", {x(random), y(random), 0});
    const auto result = autograsp(bench.world, bench.hand);
    CHECK(result.moved);
    REQUIRE(colliding_pairs(bench.world).empty());
    CHECK(bench.unrest() <= 1e-5);  // tolerance of a drive for springs at rest
    for (const int c : {0, 1}) {
      const double q = bench.dofs()[c];
      const double here = energy(bench.robot(), c, q, bench.q(c, 0), bench.q(c, 1));
      // torques of up to 8 N m on levers of 30 mm and more press with at most 260 N through a gap
      // of 0.1 mm
      CHECK(here <= min_energy_nearby(bench, c, q, 0.02) + 0.026);
    }
  }
}

TEST_CASE("with friction contact forces within their cones balance the springs' torques") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(-0.01, 0.01), y(0.03, 0.09), k(0.2, 5);
  for (int run = 0; run < cases(30); ++run) {
    SpringBench bench({k(random), k(random)}, run % 2 ? "rubber" : "plastic",
                      {x(random), y(random), 0}, run % 3 ? ball(0.015) : box(0.02, 0.02, 0.02));
    autograsp(bench.world, bench.hand);
    REQUIRE(colliding_pairs(bench.world).empty());
    CHECK(bench.unrest() <= 1e-5);
  }
}

TEST_CASE("a reopened finger follows its tendon back") {
  for (const char* material : {"frictionless", "plastic", "rubber"}) {
    SpringBench bench({1, 2}, material, {0.004, 0.06, 0});
    autograsp(bench.world, bench.hand);
    CHECK(bench.own_position(0, 0));
    const auto result = autograsp(bench.world, bench.hand, -1);
    CHECK(bench.dofs().isZero(0));
    for (const int c : {0, 1})
      for (const int j : {0, 1}) {
        CHECK(bench.q(c, j) == 0);
        CHECK_FALSE(bench.own_position(c, j));
        CHECK(result.stops[c] == DofStop::limit);
      }
  }
}

TEST_CASE("the weaker of two joints yields more") {
  // a tip against a frictionless wall: the ratio of the joints' torques is that of their levers, so
  // deviations are levers over stiffness
  const auto deviations = [](double first, double second) {
    SpringBench bench({first, second}, "frictionless", {0.005, 0.09, 0}, box(0.03, 0.01, 0.05));
    const auto result = autograsp(bench.world, bench.hand);
    CHECK(result.moved);
    const auto& joints = bench.robot().joints;
    const double q = bench.dofs()[0];
    return Eigen::Vector2d(joints[0].ratio * q - bench.q(0, 0),
                           joints[1].ratio * q - bench.q(0, 1));
  };
  const Eigen::Vector2d weak_root = deviations(1, 10), weak_tip = deviations(10, 1);
  CHECK(weak_root[0] > 0.1);
  CHECK(weak_root[0] / weak_root[1] > 3 * weak_tip[0] / weak_tip[1]);
}

TEST_CASE("closing a hand on springs is repeatable and does not depend on the pose of its world") {
  SpringBench bench({1, 2}, "plastic", {0.004, 0.06, 0}), again = bench, moved = bench;
  const Pose X(Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized())),
               {0.3, -0.2, 0.1});
  moved.world.set_pose(moved.hand, X);
  moved.world.set_pose(moved.object, X * moved.world.pose(moved.object));
  for (SpringBench* b : {&bench, &again, &moved}) autograsp(b->world, b->hand);
  CHECK(bench.world.hash() == again.world.hash());
  // gaps within the threshold differ by 0.1 mm, on fingers of 50 mm
  for (const int c : {0, 1})
    for (const int j : {0, 1}) CHECK(std::abs(bench.q(c, j) - moved.q(c, j)) < 0.005);
}

TEST_CASE("a drive with stop_at_contact stops where springs would continue") {
  SpringBench bench({1, 2}, "frictionless", {0.004, 0.06, 0});
  const auto result = autograsp(bench.world, bench.hand, 1, {.stop_at_contact = true});
  CHECK(result.stops[0] == DofStop::contact);
  CHECK(bench.touching().size() > 0);
  CHECK(std::abs(bench.q(0, 0) - bench.dofs()[0]) < 1e-12);
}
