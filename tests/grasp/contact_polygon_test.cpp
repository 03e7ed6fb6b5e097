#include "clench/grasp/measure/contact_polygon.h"

#include <doctest/doctest.h>

#include <numbers>

#include "clench/base/random.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

std::vector<Vector3d> regular_polygon(int corners, double radius) {
  std::vector<Vector3d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return points;
}

}  // namespace

TEST_CASE("a regular polygon has no irregularity and the area of its formula") {
  for (int n = 3; n <= 12; ++n) {
    const ContactPolygon polygon = contact_polygon(regular_polygon(n, 0.03));
    CHECK(polygon.corners.size() == static_cast<size_t>(n));
    CHECK(
        polygon.area ==
        doctest::Approx(0.5 * n * 0.03 * 0.03 * std::sin(2 * std::numbers::pi / n)).epsilon(1e-12));
    CHECK(polygon.irregularity < 1e-12);
    CHECK(std::abs(polygon.normal.z()) == doctest::Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("a right triangle deviates by its angles: 30 + 15 + 15 of 240 degrees") {
  const ContactPolygon polygon = contact_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(polygon.irregularity == doctest::Approx(60.0 / 240).epsilon(1e-12));
  CHECK(polygon.area == doctest::Approx(0.5).epsilon(1e-12));
}

TEST_CASE("points inside or on the edges are not corners") {
  std::vector<Vector3d> points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  points.insert(points.end(), {{1, 0, 0}, {1, 1, 0}, {0.3, 1.2, 0}, {2, 2, 0}, {0, 0, 0}});
  const ContactPolygon polygon = contact_polygon(points);
  CHECK(polygon.corners.size() == 4);
  CHECK(polygon.area == doctest::Approx(4).epsilon(1e-12));
  CHECK(polygon.irregularity < 1e-7);
}

TEST_CASE("one point, two points, and collinear points have no area") {
  for (const auto& points : {std::vector<Vector3d>{{1, 2, 3}},
                             {{1, 2, 3}, {1, 2, 3}},
                             {{0, 0, 0}, {1, 1, 1}},
                             {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}}) {
    const ContactPolygon polygon = contact_polygon(points);
    CHECK(polygon.area == 0);
    CHECK(polygon.irregularity == 1);
    CHECK(polygon.corners.size() <= 2);
  }
}

TEST_CASE(
    "a moved, turned and shuffled polygon is the same, and its area scales with the square of "
    "size") {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 7; ++i)
      points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.1, 0.1));
    const ContactPolygon polygon = contact_polygon(points);
    const Pose X = random_pose(random, 2.0);
    std::vector<Vector3d> moved(points.rbegin(), points.rend());
    for (Vector3d& p : moved) p = X * (3 * p);
    const ContactPolygon other = contact_polygon(moved);
    CHECK(other.corners.size() == polygon.corners.size());
    CHECK(other.area == doctest::Approx(9 * polygon.area).epsilon(1e-9));
    CHECK(other.irregularity == doctest::Approx(polygon.irregularity).epsilon(1e-9));
    CHECK((other.centroid - X * (3 * polygon.centroid)).norm() < 1e-12 * 10);
  }
}
