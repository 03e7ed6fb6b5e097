#include "clench/motion/drive.h"

#include <array>

#include "clench/base/error.h"
#include "support/chains.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;

namespace {

using std::numbers::pi;

// a gripper and a ball or box between its fingers
struct Bench {
  World world;
  Id<Robot> hand;
  Id<Body> object;

  explicit Bench(DofKind kind = DofKind::rigid, double ratio = 0.5, Mesh mesh = ball(0.015),
                 Eigen::Vector3d at = {0, 0.07, 0}) {
    hand = world.add_robot(two_finger(kind, ratio), {});
    object = world.add_body(body_spec("object", std::move(mesh)), BodyKind::object,
                            Pose::translation(at));
  }
  const Robot& robot() const { return world.robot(hand); }
  Eigen::VectorXd dofs() const { return world.dofs(hand); }
  JointPosition own_position(int chain, int joint) const {
    return world.own_joint_positions(hand)[joint_number(robot(), chain, joint)];
  }
  Id<Body> link(int chain, int link) const { return link_of(robot(), chain, link); }
  double gap(Id<Body> a) const {
    const std::array ga{a}, gb{object};
    return distance(world, ga, gb).distance;
  }
};

}  // namespace

TEST_CASE("closing stops both fingers on the object with a gap within the threshold") {
  Bench bench;
  const auto result = autograsp(bench.world, bench.hand);
  CHECK(result.moved);
  CHECK(colliding_pairs(bench.world).empty());
  for (const int c : {0, 1}) {
    CHECK(result.stops[c] == DofStop::contact);
    const double gap = std::min(bench.gap(bench.link(c, 0)), bench.gap(bench.link(c, 1)));
    CHECK(gap > 0);
    CHECK(gap <= bench.world.contact_threshold());
  }
  // two mirrored fingers on a centered ball close equally, up to the contact threshold
  CHECK(std::abs(bench.dofs()[0] - bench.dofs()[1]) < 0.01);
}

TEST_CASE("closing again moves nothing") {
  for (const auto kind : {DofKind::rigid, DofKind::breakaway}) {
    Bench bench(kind);
    autograsp(bench.world, bench.hand);
    const Eigen::VectorXd before = bench.dofs();
    const auto again = autograsp(bench.world, bench.hand);
    CHECK_FALSE(again.moved);
    CHECK((bench.dofs() - before).cwiseAbs().maxCoeff() < 1e-5);
  }
}

TEST_CASE("an empty hand closes until its fingers touch") {
  Bench bench(DofKind::rigid, 0.5, ball(0.015), {0, 1, 0});
  const auto result = autograsp(bench.world, bench.hand);
  CHECK(colliding_pairs(bench.world).empty());
  for (const auto stop : result.stops) CHECK(stop == DofStop::contact);
  const std::array left{bench.link(0, 1)}, right{bench.link(1, 1)};
  const double gap = distance(bench.world, left, right).distance;
  CHECK(gap > 0);
  CHECK(gap <= bench.world.contact_threshold());
}

TEST_CASE("a long drive does not tunnel through a thin wall") {
  // half a millimeter thin, in the path of both fingers
  Bench bench(DofKind::rigid, 0.5, box(0.0005, 0.2, 0.2), {0, 0.15, 0});
  autograsp(bench.world, bench.hand);
  for (const int c : {0, 1})
    for (const int l : {0, 1}) {
      const double x = bench.world.pose(bench.link(c, l)).position.x();
      CHECK((c == 0 ? x > 0 : x < 0));
    }
}

TEST_CASE("a breakaway finger continues to close beyond the joint that contact stopped") {
  // the first link touches the ball early, while the second one is still free
  Bench rigid(DofKind::rigid, 0.5, ball(0.02), {0, 0.03, 0});
  Bench breakaway(DofKind::breakaway, 0.5, ball(0.02), {0, 0.03, 0});
  autograsp(rigid.world, rigid.hand);
  autograsp(breakaway.world, breakaway.hand);
  const JointPosition left = breakaway.own_position(0, 0);
  REQUIRE(left);
  CHECK(*left == doctest::Approx(rigid.dofs()[0]).epsilon(0.02));
  CHECK(breakaway.dofs()[0] > rigid.dofs()[0] + 0.1);
  CHECK(breakaway.world.joints(breakaway.hand)[1] > rigid.world.joints(rigid.hand)[1] + 0.05);
  CHECK(colliding_pairs(breakaway.world).empty());

  // opening recouples the joint at the position where it broke away
  open_hand(breakaway.world, breakaway.hand);
  CHECK_FALSE(breakaway.own_position(0, 0));
  CHECK(breakaway.dofs() == Eigen::Vector2d(0, 0));
}

TEST_CASE(
    "a drive without obstacles reaches its targets exactly, on a straight line in DOF space") {
  Bench bench(DofKind::rigid, 0.5, ball(0.01), {0, 2, 0});
  const auto result = drive_to(bench.world, bench.hand, Eigen::Vector2d(0.123456789, 0.2));
  CHECK(bench.dofs() == Eigen::Vector2d(0.123456789, 0.2));
  CHECK(result.stops[0] == DofStop::reached);
  CHECK(result.moved);
}

TEST_CASE("stop_at_contact ends at the first contact of any finger") {
  Bench bench(DofKind::rigid, 0.5, ball(0.01), {0.012, 0.07, 0});
  autograsp(bench.world, bench.hand, 1, {.stop_at_contact = true});
  CHECK(bench.gap(bench.link(0, 1)) <= bench.world.contact_threshold());
  CHECK(bench.gap(bench.link(1, 1)) > 0.001);
}

TEST_CASE("only the sign of the speed matters: closing twice as fast ends at the same values") {
  Bench slow, fast;
  autograsp(slow.world, slow.hand, 1);
  autograsp(fast.world, fast.hand, 1024);
  CHECK(slow.dofs() == fast.dofs());
  Bench crawling;
  autograsp(crawling.world, crawling.hand, 1e-300);
  CHECK((slow.dofs() - crawling.dofs()).norm() < 1e-12);
}

TEST_CASE("the grasp moves with the world") {
  Bench here, there;
  const Pose X{Eigen::Quaterniond(Eigen::AngleAxisd(2, Eigen::Vector3d(2, -1, 2) / 3)),
               {0.3, -0.2, 0.5}};
  there.world.set_pose(there.hand, X);
  there.world.set_pose(there.object, X * there.world.pose(there.object));
  autograsp(here.world, here.hand);
  autograsp(there.world, there.hand);
  // the stop may be anywhere within the threshold with a lever of 40 mm, but only rounding makes a
  // difference
  CHECK((here.dofs() - there.dofs()).norm() < 1e-9);
}

TEST_CASE("an initial collision is an error that names the pair") {
  Bench bench(DofKind::rigid, 0.5, ball(0.02), {0.03, 0.05, 0});
  CHECK_THROWS_WITH_AS(autograsp(bench.world, bench.hand),
                       "driving 'gripper': the motion starts in collision: gripper_chain0_link0 "
                       "and object, gripper_chain0_link1 and object",
                       Error);
}

TEST_CASE("opening frees a hand that overlaps, or reports that it cannot") {
  Bench bench(DofKind::rigid, 0.5, ball(0.02), {0, 0.07, 0});
  bench.world.set_dofs(bench.hand, Eigen::Vector2d(0.6, 0.6));
  REQUIRE_FALSE(colliding_pairs(bench.world).empty());
  open_hand(bench.world, bench.hand);
  CHECK(colliding_pairs(bench.world).empty());
  CHECK(bench.dofs() == Eigen::Vector2d(0, 0));

  Bench stuck(DofKind::rigid, 0.5, ball(0.02), {0.03, 0.05, 0});
  CHECK_THROWS_AS(open_hand(stuck.world, stuck.hand), Error);
}

TEST_CASE("invalid arguments of a drive are rejected") {
  Bench bench;
  CHECK_THROWS_WITH_AS(autograsp(bench.world, bench.hand, 0),
                       "autograsp of 'gripper': the speed must be finite and not 0, got 0", Error);
  CHECK_THROWS_WITH_AS(drive_to(bench.world, bench.hand, Eigen::Vector3d(0, 0, 0)),
                       "driving 'gripper': expected 2 DOF values, got 3", Error);
  CHECK_THROWS_WITH_AS(drive_to(bench.world, bench.hand, Eigen::Vector2d(0, 9)),
                       "driving 'gripper': DOF 2 must lie in [0, 1.571] rad, got 9; degrees? "
                       "clench.rad(9) is 0.1571",
                       Error);
  CHECK_THROWS_WITH_AS(drive_to(bench.world, bench.hand, Eigen::Vector2d(0, NAN)),
                       "driving 'gripper': DOF 2 must be finite, got nan", Error);
}
