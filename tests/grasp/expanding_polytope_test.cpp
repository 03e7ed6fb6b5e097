#include "clench/grasp/wrench/expanding_polytope.h"

#include <numbers>

#include "clench/base/random.h"
#include "clench/grasp/wrench/wrench_hull.h"
#include "clench/grasp/wrench/wrench_support.h"
#include "grasp/wrench_sets.h"
#include "support/linear.h"

using namespace clench;
using namespace clench::test;

namespace {

WrenchSupport reach_of(const Eigen::MatrixXd& points) {
  const ContactPart part{.points = points.data(), .count = static_cast<int>(points.cols())};
  return WrenchSupport(static_cast<int>(points.rows()), WrenchNorm::l1, std::span(&part, 1));
}

Eigen::MatrixXd cross_polytope(int d) {
  Eigen::MatrixXd out(d, 2 * d);
  out << Eigen::MatrixXd::Identity(d, d), -Eigen::MatrixXd::Identity(d, d);
  return out;
}

Eigen::MatrixXd cube(int d) {
  Eigen::MatrixXd out(d, 1 << d);
  for (int i = 0; i < out.cols(); ++i)
    for (int row = 0; row < d; ++row) out(row, i) = (i >> row & 1) ? 1 : -1;
  return out;
}

Eigen::MatrixXd random_points(Random& random, int d, int count) {
  Eigen::MatrixXd out(d, count);
  for (double& x : out.reshaped()) x = random.normal();
  return out / 4;
}

double factorial(int n) { return n <= 1 ? 1 : n * factorial(n - 1); }

// a ball of radius one, shifted
class RoundSet final : public SupportSet {
 public:
  explicit RoundSet(const Eigen::VectorXd& center) : center_(center) {}
  int dimension() const override { return static_cast<int>(center_.size()); }
  double support(const double* direction, double* point) const override {
    const Eigen::Map<const Eigen::VectorXd> u(direction, dimension());
    Eigen::Map<Eigen::VectorXd>(point, dimension()) = center_ + u.normalized();
    return u.dot(center_) + u.norm();
  }

 private:
  Eigen::VectorXd center_;
};

}  // namespace

TEST_CASE("the ball inside a cross polytope and a cube, in two to six dimensions") {
  for (int d = 2; d <= 6; ++d) {
    const Ball in_cross = largest_ball(reach_of(cross_polytope(d)));
    CHECK(in_cross.end == BallEnd::inside);
    CHECK(std::abs(in_cross.upper - 1 / std::sqrt(d)) < 1e-14);
    CHECK(std::abs(in_cross.lower - 1 / std::sqrt(d)) < 1e-12);
    const Ball in_cube = largest_ball(reach_of(cube(d)));
    CHECK(in_cube.end == BallEnd::inside);
    CHECK(std::abs(in_cube.upper - 1) < 1e-14);
  }
}

TEST_CASE("the volume of a cross polytope and a cube, in two to six dimensions") {
  for (int d = 2; d <= 6; ++d) {
    const Facets cross = all_facets(reach_of(cross_polytope(d)));
    REQUIRE(cross.end == FacetsEnd::complete);
    CHECK(cross.volume == doctest::Approx((1 << d) / factorial(d)).epsilon(1e-13));
    CHECK(static_cast<int>(cross.corners.size()) == d * (1 << d));  // 2^d simplices
    const Facets all = all_facets(reach_of(cube(d)));
    REQUIRE(all.end == FacetsEnd::complete);
    CHECK(all.volume == doctest::Approx(1 << d).epsilon(1e-13));
  }
}

TEST_CASE("cyclic polytopes have the maximal number of facets of the closed formula") {
  // points on the curve (cos t, sin t, cos 2t, sin 2t, ...)   source  Gale (1963)
  const auto cyclic = [](int d, int count) {
    Eigen::MatrixXd points(d, count);
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < d; ++k) {
        const double angle = (k / 2 + 1) * 2 * std::numbers::pi * i / count;
        points(k, i) = k % 2 ? std::sin(angle) : std::cos(angle);
      }
    return points;
  };
  for (const int count : {7, 8, 12, 30}) {
    const int four = count * (count - 3) / 2;
    const int six = count * (count - 4) * (count - 5) / 6;
    for (const auto& [d, expected] : {std::pair(2, count), {4, four}, {6, six}}) {
      const Facets facets = all_facets(reach_of(cyclic(d, count)));
      REQUIRE(facets.end == FacetsEnd::complete);
      CHECK(static_cast<int>(facets.corners.size()) == expected * d);
    }
  }
}

TEST_CASE("random sets in two to six dimensions have the ball, volume and facets of their hull") {
  Random random(1);
  for (int d = 2; d <= 6; ++d)
    for (int trial = 0; trial < 30; ++trial) {
      const Eigen::MatrixXd points = random_points(random, d, d + 1 + trial);
      const Hull hull = convex_hull(points);
      const Ball ball = largest_ball(reach_of(points));
      const double offset = hull.offsets.minCoeff();
      if (offset > 1e-12)
        CHECK(std::abs(ball.upper - offset) < 1e-12);
      else
        CHECK(ball.end == BallEnd::outside);
      const Facets facets = all_facets(reach_of(points));
      REQUIRE(facets.end == FacetsEnd::complete);
      CHECK(facets.volume == doctest::Approx(hull.volume).epsilon(1e-12));
      CHECK(facets.corners.size() == hull.facets.size() * d);  // in general position, all simplices
    }
}

TEST_CASE("a round set is bracketed to the requested tolerance, with no more points than needed") {
  for (int d = 2; d <= 6; ++d) {
    // the nearest point of the sphere is unique, and its distance grows quadratically around it
    const RoundSet set(0.4 * Eigen::VectorXd::Ones(d).normalized());
    int last = 0;
    for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
      const Ball ball = largest_ball(set, {.tolerance = tolerance});
      CHECK(ball.end == BallEnd::inside);
      CHECK(ball.upper - ball.lower <= tolerance);
      CHECK(ball.lower <= 0.6 + 1e-13);
      CHECK(ball.upper >= 0.6 - 1e-13);
      CHECK(ball.points >= last);
      last = ball.points;
    }
  }
}

TEST_CASE("a round set that touches or excludes the origin has no ball") {
  for (const double off : {1.0, 1.0 + 1e-9, 1.5, 30.0})
    CHECK(largest_ball(RoundSet(off * Eigen::VectorXd::Unit(6, 2))).end == BallEnd::outside);
  CHECK(largest_ball(RoundSet(0.9 * Eigen::VectorXd::Unit(6, 2)), {.tolerance = 1e-2}).end ==
        BallEnd::inside);
}

TEST_CASE("the test whether the ball reaches a radius stops early, with the correct answer") {
  Random random(2);
  int early = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const auto set = side_by_side(wrench_set(0, static_cast<uint64_t>(trial)));
    const WrenchSupport reach = reach_of(set / 4);
    const Ball whole = largest_ball(reach);
    if (whole.end != BallEnd::inside) continue;
    for (const double part : {0.1, 0.9, 0.999, 1.001, 1.1, 3.0}) {
      const Ball ball = largest_ball(reach, {.at_least = part * whole.upper});
      const bool reaches = ball.lower >= part * whole.upper;
      CHECK((reaches || ball.upper < part * whole.upper));
      CHECK(reaches == (part < 1));
      early += ball.points < whole.points;
    }
  }
  CHECK(early > 50);
}

TEST_CASE("a limit on the number of points leaves a valid bracket") {
  const RoundSet set(Eigen::VectorXd::Zero(6));  // all directions are equivalent: the hardest case
  const Ball ball = largest_ball(set, {.tolerance = 1e-9, .max_points = 40});
  CHECK(ball.end == BallEnd::stopped);
  CHECK(ball.points <= 40);
  CHECK(ball.lower < 1);
  CHECK(ball.upper >= 1 - 1e-13);
}

TEST_CASE("flat sets are reported, with the direction across") {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::MatrixXd points = random_points(random, 6, 30);
    points.row(5).setZero();
    const Eigen::MatrixXd turn = random_turn(6, random);
    const Ball ball = largest_ball(reach_of(turn * points), {.zero = -1});
    CHECK(ball.end == BallEnd::flat);
    const Eigen::Map<const Vector6d> across(ball.direction);
    CHECK(std::abs(std::abs(across.dot(turn.col(5))) - 1) < 1e-9);
    CHECK(all_facets(reach_of(turn * points)).end == FacetsEnd::flat);
  }
}

TEST_CASE("a hull with too many facets is abandoned, and reported") {
  Random random(4);
  const WrenchSupport reach = reach_of(random_points(random, 6, 60));
  CHECK(all_facets(reach, {.max_facets = 500}).end == FacetsEnd::too_many);
}

TEST_CASE("hard sets of every kind: ball and volume equal those of the hull by qhull") {
  int inside = 0, volumes = 0;
  for (int kind = 0; kind < wrench_set_kinds; ++kind)
    for (uint64_t number = 0; number < 25; ++number) {
      CAPTURE(wrench_set_kind(kind));
      CAPTURE(number);
      Wrenches all = side_by_side(wrench_set(kind, number));
      all /= all.colwise().norm().maxCoeff();
      const Ball ball = largest_ball(reach_of(all));
      CHECK(ball.end != BallEnd::stopped);
      const Hull hull = affine_rank(all) == 6 ? wrench_hull(all) : Hull();
      const double offset = hull.dimension == 6 ? hull.offsets.minCoeff() : 0;
      // the perturbations used as a last resort, here and in wrench_hull, are about 1e-10
      if (ball.end == BallEnd::inside) {
        CHECK(std::abs(ball.upper - std::max(0.0, offset)) < 1e-9);
        CHECK(ball.upper - ball.lower < 1e-9);
        ++inside;
      } else {
        CHECK(offset < 1e-9);
      }
      if (hull.dimension != 6) continue;
      const Facets facets = all_facets(reach_of(all));
      if (facets.end != FacetsEnd::complete) continue;
      CHECK(facets.volume == doctest::Approx(hull.volume).epsilon(1e-8));
      ++volumes;
    }
  CHECK(inside > 200);
  CHECK(volumes > 250);
}
