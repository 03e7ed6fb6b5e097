#include "clench/geometry/mesh/triangulate.h"

#include <Eigen/Geometry>
#include <numbers>

#include "clench/base/error.h"
#include "clench/base/random.h"

using namespace clench;
using Points = std::vector<Eigen::Vector3d>;

/// Twice the sum of the area vectors of the triangles, and the sum of their lengths.
static std::pair<Eigen::Vector3d, double> areas(const Points& p,
                                                const std::vector<Triangle>& triangles) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double lengths = 0;
  for (const auto& t : triangles) {
    const Eigen::Vector3d a = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
    sum += a;
    lengths += a.norm();
  }
  return {sum, lengths};
}

static Eigen::Vector3d outline_area(const Points& p) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < p.size(); ++i) sum += p[i].cross(p[(i + 1) % p.size()]);
  return sum;
}

TEST_CASE(
    "stars in any plane are covered once: n - 2 triangles with the orientation of the outline") {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const int n = 4 + static_cast<int>(random.bits() % 40);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized();
    Points p;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n, r = random.uniform(0.2, 1);
      p.push_back(turn * Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0) +
                  Eigen::Vector3d(1, 2, 3));
    }
    const auto triangles = triangulate(p);
    CHECK(triangles.size() == p.size() - 2);
    const auto [sum, lengths] = areas(p, triangles);
    // areas of size one, with a few dozen rounding errors
    CHECK((sum - outline_area(p)).norm() < 1e-12);
    CHECK(lengths == doctest::Approx(sum.norm()).epsilon(1e-12));
  }
}

TEST_CASE("a convex polygon is a fan from its first corner") {
  const Points square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(triangulate(square) == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  // corners on a straight side, and a repeated corner, do not change that
  CHECK(triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 1, 0}, {0, 1, 0}}).size() ==
        4);
}

TEST_CASE("an arrowhead is not divided through its notch") {
  const Points p = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  const auto [sum, lengths] = areas(p, triangulate(p));
  CHECK(lengths == doctest::Approx(sum.norm()));
  CHECK(areas(p, triangulate(p, true)).second ==
        doctest::Approx(areas(p, {{0, 1, 2}, {0, 2, 3}}).second));
}

TEST_CASE("any other outline gives n - 2 triangles, in finite time") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(triangulate({}).empty());
  CHECK(triangulate({{0, 0, 0}, {1, 0, 0}}).empty());
  CHECK(triangulate(Points(7, Eigen::Vector3d::Zero())).size() == 5);
  CHECK(triangulate({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}}).size() == 3);
  Random random(2);
  for (int k = 0; k < 50; ++k) {
    Points p;
    for (int i = 0; i < 12; ++i) p.push_back({random.normal(), random.normal(), random.normal()});
    CHECK(triangulate(p).size() == 10);
  }
}

TEST_CASE("a crooked face with very many corners is rejected") {
  Random random(3);
  Points p;
  for (int i = 0; i <= max_concave_corners; ++i) p.push_back({random.normal(), random.normal(), 0});
  CHECK_THROWS_WITH_AS(triangulate(p),
                       "expected at most 1000 corners of a face that is not convex, got 1001",
                       Error);
  CHECK(triangulate(p, true).size() == p.size() - 2);
}
