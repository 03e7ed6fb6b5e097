#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

TEST_CASE("a region contains exactly the triangles closer than the radius, in order") {
  Random random(1);
  for (const auto& shape : {Shape::make(soup(random, 150)), Shape::make(potato(random))})
    for (int i = 0; i < 150; ++i) {
      const Vector3d p = random_point(random, 0.7);
      const double radius = random.uniform(-0.1, 0.8);
      std::vector<int> expected;
      for (int t = 0; shape->has_triangle(t); ++t)
        if (point_triangle(p, shape->mesh().corners(t)).distance < radius) expected.push_back(t);
      CHECK(region(*shape, p, radius) == expected);
    }
}

TEST_CASE("a radius of 0 selects nothing, an infinite one everything, and NaN is rejected") {
  const auto shape = Shape::make(box(1, 1, 1));
  CHECK(region(*shape, {0.5, 0, 0}, 0).empty());
  CHECK(region(*shape, {0.5, 0, 0}, std::numeric_limits<double>::infinity()).size() == 12);
  CHECK_THROWS_WITH_AS(region(*shape, {0, 0, 0}, std::nan("")),
                       "region: point and radius must be numbers [m], got (0, 0, 0), nan", Error);
  CHECK_THROWS_AS(region(*shape, {std::nan(""), 0, 0}, 1), Error);
}
