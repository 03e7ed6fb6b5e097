#include "clench/planning/space/search_space.h"

#include <numbers>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "planning/scene.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

// values within the ranges, including circular ones
Values random_values(const SearchSpace& space, Random& random) {
  Values out(space.variables().size());
  for (int i = 0; i < out.size(); ++i)
    out[i] = random.uniform(space.variables()[i].min, space.variables()[i].max);
  return out;
}

double gap(const HandState& a, const HandState& b) {
  const Pose between = a.X_RH.inverse() * b.X_RH;
  return std::max(
      {between.position.norm(), between.angle(), (a.dofs - b.dofs).lpNorm<Eigen::Infinity>()});
}

}  // namespace

TEST_CASE("values of a state reproduce that state, in every space") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  Random random(1);
  for (const auto position : {PositionKind::complete, PositionKind::axis_angle,
                              PositionKind::ellipsoid, PositionKind::approach, PositionKind::fixed})
    for (const auto posture : {PostureKind::eigengrasps, PostureKind::dofs, PostureKind::fixed}) {
      SearchSpace space(scene.robot(), scene.state(), {.position = position, .posture = posture});
      for (int i = 0; i < 50; ++i) {
        const HandState state = space.state(random_values(space, random));
        // postures clamped at the limits are no longer sums of eigengrasps
        if (posture == PostureKind::eigengrasps)
          space = SearchSpace(scene.robot(), state,
                              {.position = position, .posture = PostureKind::fixed});
        const HandState again = space.state(space.values(state));
        // a few rounding errors of lengths of a meter; angles near pi lose half the digits
        CHECK(gap(state, again) < 1e-7);
        if (posture == PostureKind::eigengrasps) break;
      }
    }
}

TEST_CASE(
    "an axis-angle pose is a translation and a rotation about an axis, behind the approach frame") {
  const HandScene scene = hand_scene("human/human16.cfg", "flask.iv");
  SearchSpace space(scene.robot(), scene.state(), {.posture = PostureKind::fixed});
  Values v(6);
  v << 0.1, -0.05, 0.2, pi / 2, pi / 3, 0.7;
  const Pose X_RA = space.state(v).X_RH * scene.robot().X_BA;
  CHECK((X_RA.position - Vector3d(0.1, -0.05, 0.2)).norm() < 1e-12);
  const Vector3d axis(std::cos(pi / 3), std::sin(pi / 3), 0);
  CHECK((X_RA.rotation * axis - axis).norm() < 1e-12);
  CHECK(X_RA.angle() == doctest::Approx(0.7));
}

TEST_CASE("a rotation about z has no singularity: theta is 0 or pi there") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  SearchSpace space(scene.robot(), scene.state(), {.posture = PostureKind::fixed});
  for (const double angle : {0.5, -0.5}) {
    HandState state = scene.state();
    state.X_RH = Pose::turn(angle, Vector3d::UnitZ()) * scene.robot().X_BA.inverse();
    const Values v = space.values(state);
    CHECK(v[3] == doctest::Approx(angle > 0 ? 0 : pi));
    CHECK(gap(space.state(v), state) < 1e-12);
  }
}

TEST_CASE(
    "on the ellipsoid the approach direction is the inward normal, and dist is the distance from "
    "the surface") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  const Vector3d semi(0.08, 0.05, 0.16);
  SearchSpace space(
      scene.robot(), scene.state(),
      {.position = PositionKind::ellipsoid, .posture = PostureKind::fixed, .semi_axes = semi});
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    Values v = random_values(space, random);
    const Pose X = space.state(v).X_RH * scene.robot().X_BA;
    const Vector3d n = X.rotation * Vector3d::UnitZ();
    const Vector3d p = X.position + v[3] * n;
    CHECK(p.cwiseQuotient(semi).squaredNorm() == doctest::Approx(1));
    const Vector3d gradient = p.cwiseQuotient(semi.cwiseAbs2()).normalized();
    CHECK((n + gradient).norm() < 1e-9);
  }
}

TEST_CASE(
    "an approach distance moves the hand along the approach direction from its current pose") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  SearchSpace space(scene.robot(), scene.state(),
                    {.position = PositionKind::approach, .posture = PostureKind::fixed});
  Values v = Values::Zero(3);
  v[0] = 0.07;
  const Pose moved = scene.state().X_RH.inverse() * space.state(v).X_RH;
  CHECK((moved.position - 0.07 * (scene.robot().X_BA.rotation * Vector3d::UnitZ())).norm() < 1e-12);
  CHECK(moved.angle() < 1e-12);
}

TEST_CASE("the distance of states is the largest of position, rotation and posture") {
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  SearchSpace space(scene.robot(), scene.state(), {});
  const HandState a = scene.state();
  HandState b = a;
  CHECK(space.distance(a, b, 0.1, true) == doctest::Approx(0));
  b.X_RH.position.x() += 0.03;
  CHECK(space.distance(a, b, 0.1, true) == doctest::Approx(0.3));
  b = a;
  b.X_RH = a.X_RH * scene.robot().X_BA * Pose::turn(pi / 2, Vector3d::UnitX()) *
           scene.robot().X_BA.inverse();
  CHECK(space.distance(a, b, 0.1, true) == doctest::Approx(0.25));
  b = a;
  b.dofs[1] += 0.5 * (scene.robot().limits[1][1] - scene.robot().limits[1][0]);
  CHECK(space.distance(a, b, 0.1, true) == doctest::Approx(0.5));
  CHECK(space.distance(a, b, 0.1, false) == doctest::Approx(0));
}

TEST_CASE("impossible settings of variables are rejected by name") {
  CHECK_THROWS_WITH_AS(check_variable({.name = "Tx", .min = 2, .max = 1}),
                       "search variable 'Tx': min 2 exceeds max 1", Error);
  CHECK_THROWS_WITH_AS(check_variable({.name = "Tx", .min = 0, .max = 1, .value = 2}),
                       "search variable 'Tx': the value must lie in [0, 1], got 2", Error);
  CHECK_THROWS_WITH_AS(check_variable({.name = "Tx", .jump = 0}),
                       "search variable 'Tx': the jump must be > 0, got 0", Error);
  CHECK_THROWS_WITH_AS(check_variable({.name = "Tx", .confidence = 1}),
                       "search variable 'Tx': the confidence must lie in [0, 1), got 1", Error);
  CHECK_THROWS_WITH_AS(
      check_variable({.name = "Tx", .min = 0, .max = std::numeric_limits<double>::infinity()}),
      "search variable 'Tx': expected a finite range, got 0 to inf", Error);
  CHECK_THROWS_AS(check_variable({.name = "Tx", .target = std::numeric_limits<double>::infinity()}),
                  Error);
  CHECK_THROWS_WITH_AS(check_variable({}), "a search variable: expected a name", Error);
  const HandScene scene = hand_scene("barrett/barrett.cfg", "mug.iv");
  SearchSpace space(scene.robot(), scene.state(), {});
  CHECK_THROWS_WITH_AS(space.add_variable({.name = "Tx"}),
                       "search variable 'Tx': the name is used twice", Error);
  CHECK_THROWS_WITH_AS(SearchSpace(scene.robot(), scene.state(), {.semi_axes = {0.1, 0, 0.1}}),
                       "search space: semi-axes: expected lengths > 0 [m], got 0", Error);
}

TEST_CASE("circular variables wrap around, and others are clamped") {
  const Variable turn{.name = "phi", .min = -pi, .max = pi, .circular = true};
  CHECK(inside(turn, pi + 0.1) == doctest::Approx(-pi + 0.1));
  CHECK(inside(turn, -pi - 0.1) == doctest::Approx(pi - 0.1));
  const Variable way{.name = "Tx", .min = 0, .max = 1};
  CHECK(inside(way, 1.5) == 1);
  CHECK(inside(way, -3) == 0);
}
