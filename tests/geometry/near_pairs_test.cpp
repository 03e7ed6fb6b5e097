#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;

TEST_CASE(
    "pairs within a threshold equal a search of all pairs, in order, with their nearest points") {
  Random random(1);
  const auto soup_a = Shape::make(soup(random, 45)), soup_b = Shape::make(soup(random, 30));
  const auto ball_a = Shape::make(potato(random, 0.5, 4)),
             ball_b = Shape::make(potato(random, 0.4, 4));
  int found = 0;
  for (int i = 0; i < 80; ++i) {
    const Shape &a = i % 2 ? *soup_a : *ball_a, &b = i % 2 ? *soup_b : *ball_b;
    const Pose X = random_pose(random, 1);
    const double threshold = i % 3 == 0 ? 1e-4 : random.uniform(0, 0.3);
    const auto pairs = pairs_within(a, b, X, threshold);
    size_t k = 0;
    for (int s = 0; a.has_triangle(s); ++s)
      for (int t = 0; b.has_triangle(t); ++t) {
        const Closest c = triangle_triangle(a.mesh().corners(s), corners_at(b, X, t));
        if (!(c.distance < threshold)) continue;
        REQUIRE(k < pairs.size());
        CHECK(pairs[k].triangle_a == s);
        CHECK(pairs[k].triangle_b == t);
        CHECK(std::abs(pairs[k].distance - c.distance) < 1e-14);
        CHECK(std::abs((pairs[k].p_a - pairs[k].p_b).norm() - c.distance) < 1e-14);
        ++k, ++found;
      }
    CHECK(k == pairs.size());
  }
  CHECK(found > 1000);
}

TEST_CASE("faces in contact give all their pairs, and none at threshold 0") {
  const auto a = Shape::make(box(1, 1, 1));
  const Pose X = Pose::translation({0, 0, 1});
  const auto pairs = pairs_within(*a, *a, X, 1e-9);
  int top_and_bottom = 0;
  for (const TrianglePair& p : pairs) {
    CHECK(p.distance == 0);
    CHECK(p.p_a == p.p_b);
    top_and_bottom += (p.triangle_a == 2 || p.triangle_a == 3) && p.triangle_b <= 1;
  }
  CHECK(top_and_bottom == 4);
  CHECK(pairs_within(*a, *a, X, 0).empty());
  CHECK(pairs_within(*a, *a, X, -1).empty());
  CHECK(pairs_within(*a, *a, X, 100).size() == 144);
  CHECK(pairs_within(*a, *a, X, std::numeric_limits<double>::infinity()).size() == 144);
  CHECK_THROWS_WITH_AS(pairs_within(*a, *a, X, std::nan("")),
                       "pairs_within: threshold must be a number [m], got nan", Error);
}
