#include <doctest/doctest.h>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

// Intersection of the line and the plane, if it lies in the triangle: brute-force reference. Near
// edges (within 1e-9 of the size) both results are accepted: no point is returned.
struct Expected {
  double distance = std::numeric_limits<double>::infinity();
  bool sure = true;
};

Expected first_of_all(const Mesh& mesh, const Vector3d& origin, const Vector3d& direction) {
  Expected out;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto c = mesh.corners(static_cast<int>(i));
    Eigen::Matrix3d columns;
    columns << c[1] - c[0], c[2] - c[0], -direction;
    if (std::abs(columns.determinant()) < 1e-9) continue;
    const Vector3d solved = columns.fullPivLu().solve(origin - c[0]);
    const double inside = std::min({solved[0], solved[1], 1 - solved[0] - solved[1]});
    if (std::abs(inside) < 1e-9 && solved[2] > 0) out.sure = false;
    if (inside > 0 && solved[2] >= 0) out.distance = std::min(out.distance, solved[2]);
  }
  return out;
}

}  // namespace

TEST_CASE("a ray hits the first of all triangles") {
  Random random(1);
  int hits = 0;
  for (const Mesh& mesh : {soup(random, 120), potato(random)}) {
    const auto shape = Shape::make(mesh);
    for (int i = 0; i < 150; ++i) {
      const Vector3d origin = random_point(random, 0.5), direction = random_direction(random);
      const Expected expected = first_of_all(mesh, origin, direction);
      const auto hit = cast_ray(*shape, origin, direction);
      if (!expected.sure) continue;
      REQUIRE(hit.has_value() == std::isfinite(expected.distance));
      if (!hit) continue;
      ++hits;
      // a plane hit at a grazing angle of 1e-3 loses three digits
      CHECK(hit->distance == doctest::Approx(expected.distance).epsilon(1e-11));
      CHECK((origin + hit->distance * direction - hit->point).norm() < 1e-15);
      CHECK(point_triangle(hit->point, mesh.corners(hit->triangle)).distance < 1e-12);
      CHECK_FALSE(cast_ray(*shape, origin, direction, hit->distance).has_value());
      CHECK(cast_ray(*shape, origin, direction, hit->distance * 1.000001).has_value());
    }
  }
  CHECK(hits > 100);
}

TEST_CASE("no ray passes between triangles, including rays through corners and edges") {
  Random random(2);
  const Mesh mesh = potato(random);
  const auto shape = Shape::make(mesh);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d origin = random_point(random, 0.1);
    const Triangle& t = mesh.triangles[i % mesh.triangles.size()];
    const double along = i % 3 == 0 ? 0 : random.uniform();
    const Vector3d aim = (1 - along) * mesh.vertices[t[0]] + along * mesh.vertices[t[1]];
    CHECK(cast_ray(*shape, origin, (aim - origin).normalized()).has_value());
  }
}

TEST_CASE("rays along the axes of a box hit it at the expected points") {
  const auto cube = Shape::make(box(2, 2, 2));
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d direction = sign * Vector3d::Unit(axis);
      const auto out = cast_ray(*cube, {0, 0, 0}, direction),
                 in = cast_ray(*cube, 3 * direction, -direction);
      REQUIRE(out.has_value());
      REQUIRE(in.has_value());
      CHECK(out->distance == 1);
      CHECK(in->distance == 2);
      CHECK(in->point == direction);
      CHECK_FALSE(cast_ray(*cube, 3 * direction, direction).has_value());
      CHECK(cast_ray(*cube, direction, direction)->distance == 0);
    }
  // two triangles share the diagonal: the lower index is returned
  CHECK(cast_ray(*cube, {0, 0, 5}, {0, 0, -1})->triangle == 2);
}

TEST_CASE(
    "a ray whose direction is not a unit vector, or with numbers that are not finite, is "
    "rejected") {
  const auto shape = Shape::make(box(1, 1, 1));
  CHECK_THROWS_WITH_AS(cast_ray(*shape, {0, 0, 0}, {0, 0, 2}),
                       "cast_ray: direction must be a unit vector, got (0, 0, 2)", Error);
  CHECK_THROWS_AS(cast_ray(*shape, {0, 0, 0}, {0, 0, std::nan("")}), Error);
  CHECK_THROWS_WITH_AS(cast_ray(*shape, {0, 0, 0}, {0, 0, 1}, std::nan("")),
                       "cast_ray: origin and limit must be numbers [m], got (0, 0, 0), nan", Error);
  CHECK_FALSE(cast_ray(*shape, {0, 0, 1e200}, {0, 0, -1}, 1).has_value());
}
