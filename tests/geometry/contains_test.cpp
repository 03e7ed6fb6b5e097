#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

TEST_CASE("points around which the surface winds are inside, for either orientation of faces") {
  Random random(1);
  const Mesh body = potato(random, 1, 8);
  for (const auto& shape : {Shape::make(body), Shape::make(inverted(body))}) {
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
      const Vector3d p = random_point(random, 0.6);
      const bool expected = std::abs(winding(body, p)) > 0.5;
      CHECK(contains(*shape, p) == expected);
      inside += expected;
    }
    CHECK(inside > 100);
    CHECK(inside < 400);
  }
}

TEST_CASE("parts may overlap, and cavities are outside") {
  const auto two = Shape::make(joined(ball(1), moved(ball(1), Pose::translation({1, 0, 0}))));
  CHECK(contains(*two, {0.5, 0, 0}));
  CHECK(contains(*two, {-0.5, 0, 0}));
  CHECK(contains(*two, {1.5, 0, 0}));
  CHECK_FALSE(contains(*two, {0.5, 0.95, 0}));
  const auto shell = Shape::make(joined(ball(2), inverted(ball(1))));
  CHECK_FALSE(contains(*shell, {0, 0, 0}));
  CHECK(contains(*shell, {1.5, 0, 0}));
}

TEST_CASE("points very close to the surface are on the correct side") {
  Random random(2);
  const Mesh mesh = potato(random);
  const auto shape = Shape::make(mesh);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto c = mesh.corners(static_cast<int>(t));
    const Vector3d n = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    const Vector3d middle = (c[0] + c[1] + c[2]) / 3;
    for (const double hair : {1e-3, 1e-9, 1e-13}) {
      CHECK(contains(*shape, middle - hair * n));
      CHECK_FALSE(contains(*shape, middle + hair * n));
    }
  }
}

TEST_CASE("rays through corners and edges give correct results") {
  // a fine grid of points, with corners in many directions
  const auto cube = Shape::make(box(2, 2, 2));
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j)
      for (int k = -6; k <= 6; ++k) {
        const Vector3d p = Vector3d(i, j, k) / 4.0 + Vector3d::Constant(1e-3);
        CHECK(contains(*cube, p) == (p.cwiseAbs().maxCoeff() < 1));
      }
  // points from which a ray hits a corner exactly
  const auto ring = Shape::make(ball(1, 8, 16));
  for (const Vector3d& corner : ring->mesh().vertices)
    for (const Vector3d& d : {Vector3d(0.267, 0.535, 0.802), Vector3d(-0.713, 0.211, 0.671),
                              Vector3d(0.149, -0.947, -0.283)})
      for (const double back : {0.1, 0.5, 3.0}) {
        const Vector3d p = corner - back * d.normalized();
        CHECK(contains(*ring, p) == (winding(ring->mesh(), p) > 0.5));
      }
}

TEST_CASE("open meshes contain nothing, and a point that is not finite is rejected") {
  Mesh open = box(1, 1, 1);
  open.triangles.pop_back();
  CHECK_FALSE(contains(*Shape::make(open), {0, 0, 0}));
  const auto shape = Shape::make(box(1, 1, 1));
  CHECK(contains(*shape, {0, 0, 0}));
  CHECK_FALSE(contains(*shape, {1e300, 0, 0}));
  CHECK_THROWS_WITH_AS(contains(*shape, {0, 0, std::nan("")}),
                       "contains: point must be finite [m], got (0, 0, nan)", Error);
}
