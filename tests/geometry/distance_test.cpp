#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"
#include "support/meshes.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double min_of_all_pairs(const Shape& a, const Shape& b, const Pose& X_AB) {
  double least = infinity;
  for (int s = 0; a.has_triangle(s); ++s)
    for (int t = 0; b.has_triangle(t); ++t)
      least =
          std::min(least, triangle_triangle(a.mesh().corners(s), corners_at(b, X_AB, t)).distance);
  return least;
}

// nearest points lie on the named triangles, at the reported distance
void check_witness(const Shape& a, const Shape& b, const Pose& X, const Distance& d) {
  const double tolerance = 1e-14 * (1 + X.position.norm());
  REQUIRE(a.has_triangle(d.triangle_a));
  REQUIRE(b.has_triangle(d.triangle_b));
  CHECK(std::abs((d.p_a - d.p_b).norm() - d.distance) < tolerance);
  CHECK(point_triangle(d.p_a, a.mesh().corners(d.triangle_a)).distance < tolerance);
  CHECK(point_triangle(d.p_b, corners_at(b, X, d.triangle_b)).distance < tolerance);
}

// moved along the line between the nearest points, to this gap [m]
Pose closed_in(const Distance& d, Pose X, double gap) {
  X.position += (d.distance - gap) * (d.p_a - d.p_b).normalized();
  return X;
}

}  // namespace

TEST_CASE("distance of random soups is the minimum over all pairs") {
  Random random(1);
  const auto a = Shape::make(soup(random, 45)), b = Shape::make(soup(random, 30));
  for (int i = 0; i < 120; ++i) {
    const Pose X = random_pose(random, i % 3 == 0 ? 10 : 1.5);
    const Distance d = distance(*a, *b, X);
    // rounding of coordinates up to 10
    CHECK(std::abs(d.distance - min_of_all_pairs(*a, *b, X)) < 2e-14);
    CHECK((d.distance == 0) == colliding(*a, *b, X));
    check_witness(*a, *b, X, d);
  }
}

TEST_CASE(
    "distance is the minimum over all pairs far away, near and touching, and 0 for collisions") {
  Random random(2);
  const auto a = Shape::make(potato(random, 1, 6)), b = Shape::make(potato(random, 0.4, 4));
  for (int i = 0; i < 25; ++i) {
    Pose X{random_turn(random), 3 * random_direction(random)};
    const Distance start = distance(*a, *b, X);
    for (const double gap : {1.0, 1e-2, 1e-4, 1e-6, 1e-9}) {
      const Pose Y = closed_in(start, X, gap);
      const Distance d = distance(*a, *b, Y);
      // moving along the segment between the nearest points leaves exactly the intended gap
      CHECK(std::abs(d.distance - gap) < 2e-15);
      CHECK_FALSE(colliding(*a, *b, Y));
      check_witness(*a, *b, Y, d);
    }
    const Pose near = closed_in(start, X, 0.01);
    CHECK(std::abs(min_of_all_pairs(*a, *b, near) - 0.01) < 2e-15);
    for (const double depth : {1e-6, 1e-2, 0.3}) {
      const Pose Y = closed_in(start, X, -depth);
      const Distance d = distance(*a, *b, Y);
      CHECK(d.distance == 0);
      CHECK(d.p_a == d.p_b);
      CHECK(colliding(*a, *b, Y));
      check_witness(*a, *b, Y, d);
    }
  }
}

TEST_CASE("distance is symmetric") {
  Random random(3);
  const auto a = Shape::make(potato(random)), b = Shape::make(potato(random, 0.5));
  for (int i = 0; i < 100; ++i) {
    const Pose X = random_pose(random, 3);
    CHECK(std::abs(distance(*a, *b, X).distance - distance(*b, *a, X.inverse()).distance) < 1e-14);
  }
}

TEST_CASE(
    "a body inside another has distance 0 with any limit, and the reported point lies in both") {
  const auto big = Shape::make(ball(2)), small = Shape::make(box(0.1, 0.1, 0.1));
  const Pose X = Pose::translation({0.5, 0.25, 0});
  for (const double limit : {infinity, 1e-3, 0.0}) {
    const Distance d = distance(*big, *small, X, limit);
    CHECK(d.distance == 0);
    CHECK(d.p_a == d.p_b);
    CHECK((d.p_a - X.position).cwiseAbs().maxCoeff() <= 0.05 + 1e-15);
    CHECK(d.triangle_a == -1);
    CHECK(d.triangle_b >= 0);
  }
  CHECK(distance(*small, *big, X.inverse()).distance == 0);
  CHECK(distance(*small, *big, X.inverse()).triangle_b == -1);
}

TEST_CASE("only distances below the limit are found, and collisions with any limit") {
  const auto a = Shape::make(box(1, 1, 1));
  const Pose X = Pose::translation({1.5, 0.25, 0});
  CHECK(distance(*a, *a, X).distance == 0.5);
  CHECK(distance(*a, *a, X, 0.5000001).distance == 0.5);
  for (const double limit : {0.5, 0.1, 0.0, -1.0}) {
    const Distance d = distance(*a, *a, X, limit);
    CHECK(d.distance == infinity);
    CHECK(d.triangle_a == -1);
    CHECK(d.triangle_b == -1);
    CHECK(distance(*a, *a, Pose::translation({1, 0, 0}), limit).distance == 0);
  }
  CHECK_THROWS_WITH_AS(distance(*a, *a, X, std::nan("")),
                       "distance: limit must be a number [m], got nan", Error);
}

TEST_CASE("warm and cold caches give bit-identical distances along a random walk") {
  Random random(4);
  const auto a = Shape::make(potato(random)), b = Shape::make(potato(random, 0.5));
  PairCache cache{1 << 30, -9, 5, 1 << 29};
  Pose X = random_pose(random, 2);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    X = Pose{random_turn(random).slerp(0.95, X.rotation), X.position + random_point(random, 0.1)};
    if (X.position.norm() > 1.8) X.position *= 0.8;
    const Distance cold = distance(*a, *b, X), warm = distance(*a, *b, X, infinity, &cache);
    CHECK(cold.distance == warm.distance);
    CHECK(distance(*a, *b, X, 0.3, &cache).distance ==
          (cold.distance < 0.3 ? cold.distance : infinity));
    hits += cold.distance == 0;
  }
  CHECK(hits > 10);
  CHECK(hits < 290);
}

TEST_CASE("distances keep their accuracy at a micrometer, and a kilometer from the origin") {
  Random random(5);
  const Mesh mesh = potato(random, 1, 6);
  const auto a = Shape::make(mesh), b = Shape::make(scaled(mesh, 0.5));
  const double micro = 1e-6;
  const auto small_a = Shape::make(scaled(mesh, micro)),
             small_b = Shape::make(scaled(mesh, 0.5 * micro));
  const Pose far = Pose::translation({1000, -2000, 500});
  const auto far_a = Shape::make(moved(mesh, far));
  for (int i = 0; i < 50; ++i) {
    const Pose X = random_pose(random, 2);
    const double plain = distance(*a, *b, X).distance;
    const Pose S{X.rotation, micro * X.position};
    CHECK(std::abs(distance(*small_a, *small_b, S).distance - micro * plain) < 1e-14 * micro);
    // corners at 2 km are rounded to 2.3e-13 m
    CHECK(std::abs(distance(*far_a, *b, far * X).distance - plain) < 2e-12);
  }
}

TEST_CASE("real meshes: distances decrease by the displacement, and are symmetric") {
  REQUIRE_SHARED();
  Random random(6);
  const auto load = [](const char* name) {
    return Shape::make(weld(read_obj(shared() / "data" / "ycb" / name)), name);
  };
  const auto cup = load("065-c_cups.obj"), driver = load("043_phillips_screwdriver.obj");
  CHECK(cup->faults().closed());
  for (int i = 0; i < 20; ++i) {
    const Pose X{random_turn(random), cup->center() + 0.3 * random_direction(random)};
    PairCache cache;
    const Distance d = distance(*cup, *driver, X, infinity, &cache);
    if (d.distance == 0) continue;
    check_witness(*cup, *driver, X, d);
    CHECK(std::abs(distance(*driver, *cup, X.inverse()).distance - d.distance) < 1e-14);
    for (const double gap : {0.01, 1e-4, 1e-6})
      CHECK(std::abs(distance(*cup, *driver, closed_in(d, X, gap), infinity, &cache).distance -
                     gap) < 1e-15);
    CHECK(colliding(*cup, *driver, closed_in(d, X, -1e-6)));
  }
}
