#include "clench/grasp/force/resistance.h"

#include <limits>

#include "clench/base/error.h"
#include "grasp/held_object.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

TEST_CASE("two fingers of one newton hold 2 mu across them, and 1 newton along them") {
  for (const double mu : {0.3, 0.8}) {
    Held h = held(pinch(mu, 0.01));
    // L1: half a newton per finger, or all from one finger
    CHECK(resistance(h.world, h.grasp, wrench(0, 0, -2, 0, 0, 0)) == doctest::Approx(mu / 2));
    CHECK(resistance(h.world, h.grasp, wrench(3, 0, 0, 0, 0, 0)) == doctest::Approx(1.0 / 3));
    CHECK(resistance(h.world, h.grasp, wrench(0, 0, -2, 0, 0, 0), {WrenchNorm::linf}) ==
          doctest::Approx(mu));
    CHECK(resistance(h.world, h.grasp, wrench(0, 0, 0, 0.5, 0, 0)) ==
          doctest::Approx(mu * 0.01 / 0.5));
  }
  Held hard = held(pinch(0.5));
  CHECK(resistance(hard.world, hard.grasp, wrench(0, 0, 0, 1, 0, 0)) < 1e-9);
  CHECK(resistance(hard.world, hard.grasp, Vector6d::Zero()) ==
        std::numeric_limits<double>::infinity());
}

TEST_CASE(
    "no wrench of length one is resisted less than epsilon, and the weakest exactly as much") {
  for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf}) {
    Held h = held(around_ball(6, 0.7, 3));
    h.grasp.options.edges = round_edges;
    h.grasp.com = Vector3d(0.003, -0.002, 0.001);
    const WrenchSpace space = wrench_space(h.grasp, {.space = {.norm = norm}});
    REQUIRE(space.epsilon() > 0);
    const auto in_newton_meters = [&](Vector6d w) {
      w.tail<3>() *= h.grasp.rho;
      return w;
    };
    CHECK(resistance(h.world, h.grasp, in_newton_meters(space.weakest().direction), {norm}) ==
          doctest::Approx(space.epsilon()).epsilon(1e-6));
    Random random(8);
    for (int i = 0; i < 40; ++i) {
      Vector6d w;
      for (double& x : w) x = random.normal();
      CHECK(resistance(h.world, h.grasp, in_newton_meters(w.normalized()), {norm}) >=
            space.epsilon() - 1e-7);
    }
  }
}

TEST_CASE("an ellipsoid with torques of rho newton meters is the ball of epsilon") {
  for (const int edges : {8, round_edges}) {
    Held h = held(around_ball(7, 0.6, 5),
                  {Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized(), {1, 2, 3}});
    h.grasp.options.edges = edges;
    const double rho = h.grasp.rho, epsilon = wrench_space(h.grasp).epsilon();
    REQUIRE(epsilon > 0);
    CHECK(ellipsoid_resistance(h.world, h.grasp, wrench(1, 1, 1, rho, rho, rho)) ==
          doctest::Approx(epsilon).epsilon(1e-8));
    CHECK(ellipsoid_resistance(h.world, h.grasp, wrench(2, 2, 2, 2 * rho, 2 * rho, 2 * rho)) ==
          doctest::Approx(epsilon / 2).epsilon(1e-8));
  }
}

TEST_CASE("every wrench in the resisted ellipsoid is resisted") {
  Held h = held(around_ball(6, 0.7, 11), {Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {0, 0, 1}});
  h.grasp.options.edges = round_edges;
  const Vector6d axes = wrench(1, 2, 0.5, 0.02, 0.05, 0.1);
  const double multiple = ellipsoid_resistance(h.world, h.grasp, axes);
  REQUIRE(multiple > 0);
  Random random(9);
  double least = 1e300;
  for (int i = 0; i < 200; ++i) {
    Vector6d w;
    for (double& x : w) x = random.normal();
    w = axes.cwiseProduct(w.normalized());
    least = std::min(least, resistance(h.world, h.grasp, w));
  }
  CHECK(least >= multiple * (1 - 1e-6));
  // two hundred directions approximate the worst of six dimensions
  CHECK(least < 3 * multiple);
}

TEST_CASE("invalid wrenches and semi-axes are rejected") {
  Held h = held(pinch(0.5));
  CHECK_THROWS_WITH_AS(resistance(h.world, h.grasp, wrench(NAN, 0, 0, 0, 0, 0)),
                       "resistance: the wrench must be finite", Error);
  CHECK_THROWS_WITH_AS(ellipsoid_resistance(h.world, h.grasp, wrench(1, 1, 0, 1, 1, 1)),
                       "resistance: half axes of an ellipsoid must be > 0, got 0 [N or N m]",
                       Error);
}
