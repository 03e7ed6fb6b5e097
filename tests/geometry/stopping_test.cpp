// Long queries and the construction of shapes check for stops often.
#include <doctest/doctest.h>

#include "clench/base/random.h"
#include "clench/base/watched.h"
#include "clench/geometry/mesh/hull.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/tree/tree.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

namespace {

// stops at several checks, early and late
template <class Call>
void stops_anywhere(Call call) {
  uint64_t checks = 0;
  {
    const Watched watched{Progress()};
    call();
    checks = watched.checks();
  }
  REQUIRE(checks > 2);
  for (const uint64_t at : {uint64_t{1}, checks / 2, checks}) {
    Watched watched{Progress()};
    watched.stop_at(at);
    CHECK_THROWS_AS(call(), Stopped);
  }
}

// one inside the other at a constant distance, so that no triangle can be skipped
struct Nested {
  std::shared_ptr<const Shape> outer = Shape::make(ball(1, 60, 120)),
                               inner = Shape::make(ball(0.99, 60, 120));
};

}  // namespace

TEST_CASE("a query that visits all triangles checks for stops every few thousand boxes") {
  const Nested nested;
  nested.outer->tree(), nested.inner->tree();
  const auto ask = [&] { return pairs_within(*nested.outer, *nested.inner, {}, 0.02).size(); };
  const size_t count = ask();
  CHECK(count > 10'000);
  const Watched watched{Progress()};
  CHECK(ask() == count);
  CHECK(watched.checks() >= count / 10'000);
  stops_anywhere(ask);
  CHECK(ask() == count);
}

TEST_CASE(
    "the construction of a shape and its tree checks for stops every few thousand triangles") {
  const Mesh mesh = ball(1, 120, 240);
  const Watched watched{Progress()};
  const auto shape = Shape::make(mesh);
  CHECK(watched.checks() >= mesh.triangles.size() / 16'384);
  const uint64_t before = watched.checks();
  shape->tree();
  CHECK(watched.checks() - before >= mesh.triangles.size() / 1024);
}

TEST_CASE("a shape whose tree construction was stopped builds it at the next request") {
  const auto shape = Shape::make(ball(1, 60, 120)), other = Shape::make(ball(1, 60, 120));
  const Pose X_AB = Pose::translation({2.5, 0.1, 0.2});
  for (const uint64_t at : {1, 50, 500}) {
    Watched watched{Progress()};
    watched.stop_at(at);
    CHECK_THROWS_AS(shape->tree(), Stopped);
  }
  CHECK(distance(*shape, *shape, X_AB).distance == distance(*other, *other, X_AB).distance);
}

TEST_CASE("a hull stops between two added points, and frees its memory") {
  Random random(1);
  Eigen::MatrixXd points(5, 400);
  for (int i = 0; i < points.cols(); ++i) {
    for (int k = 0; k < 5; ++k) points(k, i) = random.normal();
    points.col(i).normalize();
  }
  const auto make = [&] { return convex_hull(points).facets.size(); };
  const size_t count = make();
  CHECK(count > 5000);
  uint64_t checks = 0;
  {
    const Watched watched{Progress()};
    make();
    checks = watched.checks();
  }
  CHECK(checks > count / 1000);
  for (const uint64_t at : {uint64_t{1}, checks / 2}) {
    Watched watched{Progress()};
    watched.stop_at(at);
    CHECK_THROWS_AS(make(), Stopped);
    CHECK(watched.checks() <= checks);
  }
  CHECK(make() == count);
}
