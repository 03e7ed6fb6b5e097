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

void check_against_all_triangles(const Shape& shape, const Vector3d& p, int seed) {
  double least = std::numeric_limits<double>::infinity();
  for (int t = 0; shape.has_triangle(t); ++t)
    least = std::min(least, point_triangle(p, shape.mesh().corners(t)).distance);
  const ClosestPoint c = closest_point(shape, p);
  // exactly equal: the same function of the same numbers
  CHECK(c.distance == least);
  CHECK(closest_point(shape, p, seed).distance == least);
  REQUIRE(shape.has_triangle(c.triangle));
  const Closest again = point_triangle(p, shape.mesh().corners(c.triangle));
  CHECK(again.distance == least);
  CHECK(again.q == c.point);
}

}  // namespace

TEST_CASE("the closest point equals that of a search of all triangles, with any seed") {
  Random random(1);
  for (const auto& shape : {Shape::make(soup(random, 100)), Shape::make(potato(random))})
    for (int i = 0; i < 200; ++i)
      check_against_all_triangles(*shape, random_point(random, i % 10 == 0 ? 100 : 1),
                                  static_cast<int>(random.uniform(-20, 150)));
}

TEST_CASE("a point on the surface is its own closest point") {
  const auto shape = Shape::make(ball(0.05, 20, 40));
  for (const Vector3d& p : shape->mesh().vertices) {
    const ClosestPoint c = closest_point(*shape, p);
    CHECK(c.distance == 0);
    CHECK(c.point == p);
  }
}

TEST_CASE("real meshes: the closest point equals that of a search of all triangles") {
  REQUIRE_SHARED();
  Random random(2);
  const auto apple = Shape::make(read_obj(shared() / "data" / "ycb" / "013_apple.obj"));
  for (int i = 0; i < 20; ++i)
    check_against_all_triangles(*apple, apple->center() + random_point(random, 0.1), i);
}

TEST_CASE("a search finds the same point and triangle from any starting triangle") {
  Random random(3);
  const auto shape = Shape::make(potato(random));
  Vector3d p = Vector3d::Zero();
  int seed = -1;
  for (int i = 0; i < 100; ++i) {
    p = i % 5 == 0 ? random_point(random, 2) : Vector3d(p + random_point(random, 0.01));
    const ClosestPoint seeded = closest_point(*shape, p, seed), one = closest_point(*shape, p);
    CHECK(seeded.distance == one.distance);
    CHECK(seeded.point == one.point);
    CHECK(seeded.triangle == one.triangle);
    seed = seeded.triangle;
  }
}

TEST_CASE("for thousands of equally near triangles, the first one is returned") {
  // corners of a sphere: their distances from its center are equal up to rounding
  const auto shape = Shape::make(ball(1, 40, 80));
  check_against_all_triangles(*shape, Vector3d::Zero(), 3000);
  CHECK(closest_point(*shape, Vector3d::Zero()).triangle ==
        closest_point(*shape, Vector3d::Zero(), 3000).triangle);
}

TEST_CASE("a point that is not finite is rejected") {
  const auto shape = Shape::make(box(1, 1, 1));
  CHECK_THROWS_WITH_AS(closest_point(*shape, {0, std::nan(""), 0}),
                       "closest_point: point must be finite [m], got (0, nan, 0)", Error);
  CHECK(closest_point(*shape, {1e300, 0, 0}).triangle >= 0);
}
