// A bound of a distance is a lower bound within the allowed factor, for any starting pair.
#include <doctest/doctest.h>

#include "clench/base/random.h"
#include "clench/geometry/query/queries.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace clench;

TEST_CASE("a bound is at least the requested fraction of the distance, and at most the distance") {
  Random random(12);
  int apart = 0, meeting = 0, far = 0;
  for (int n = 0; n < 600; ++n) {
    const double size = std::pow(10, random.uniform(-3, 2));
    const auto a = Shape::make(test::potato(random, size));
    const auto b = Shape::make(n % 3 ? test::potato(random, 0.5 * size)
                                     : test::box(size, 0.3 * size, 0.2 * size));
    const Pose X_AB = test::random_pose(random, 3 * size);
    const double d = distance(*a, *b, X_AB).distance;
    const double part = n % 5 ? random.uniform(0.05, 1) : 1;
    const double limit =
        n % 2 ? std::numeric_limits<double>::infinity() : random.uniform(0, 3) * size;
    // the traversal allows 64 rounding errors of single precision, twice in its stopping rule and
    // twice in its result
    const double extent = X_AB.position.norm() + 2 * (a->radius() + b->radius()) +
                          a->center().norm() + b->center().norm();
    const double rounding = 4 * 64 * 0x1p-24 * 2 * extent;
    std::array<int, 2> none = {-1, -1};
    const double bound = distance_bound(*a, *b, X_AB, limit, part, none);
    CHECK(bound >= 0);
    CHECK(bound <= limit);
    if (d > 0) CHECK(bound <= std::max(d, 0.0) * (1 + 1e-12));
    if (d == 0) {
      ++meeting;
      continue;  // for a body inside another, nothing is guaranteed
    }
    CHECK(bound >= std::min(limit, part * d) - rounding);
    d < limit ? ++apart : ++far;
    // from any starting pair
    const auto count = [](const Shape& s) { return static_cast<int>(s.mesh().triangles.size()); };
    std::array<int, 2> any = {static_cast<int>(random.uniform() * count(*a)),
                              static_cast<int>(random.uniform() * count(*b))};
    const double seeded = distance_bound(*a, *b, X_AB, limit, part, any);
    CHECK(seeded <= d * (1 + 1e-12));
    CHECK(seeded >= std::min(limit, part * d) - rounding);
    // and the same query has the same answer
    std::array<int, 2> again = {-1, -1};
    CHECK(distance_bound(*a, *b, X_AB, limit, part, again) == bound);
    CHECK(again == none);
  }
  CHECK(apart > 100);
  CHECK(far > 20);
  CHECK(meeting > 20);
}

TEST_CASE("intersecting surfaces have a bound of 0") {
  const auto box = Shape::make(test::box(1, 1, 1));
  std::array<int, 2> near = {-1, -1};
  const Pose X_AB{Eigen::Quaterniond::Identity(), {0.9, 0.1, 0.2}};
  CHECK(distance_bound(*box, *box, X_AB, 10, 0.5, near) == 0);
}
