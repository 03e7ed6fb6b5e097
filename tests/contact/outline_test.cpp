#include "clench/contact/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "clench/base/random.h"

using namespace clench;
using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

static double cross(const Vector2d& o, const Vector2d& a, const Vector2d& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

// brute-force reference: a point is a corner if it is the farthest in some direction
static std::set<int> slow_hull(const Points& points) {
  std::set<int> corners;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (i == j) continue;
      bool all_left = true;
      for (int k = 0; k < n && all_left; ++k)
        all_left = k == i || k == j || cross(points[i], points[j], points[k]) > 0;
      if (all_left) corners.insert(i), corners.insert(j);
    }
  return corners;
}

TEST_CASE("the outline of scattered points is their convex hull, counter-clockwise") {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    Points points;
    for (int i = 0; i < 3 + trial % 30; ++i) points.emplace_back(random.normal(), random.normal());
    const auto corners = outline(points, 0);
    CHECK(std::set<int>(corners.begin(), corners.end()) == slow_hull(points));
    const size_t n = corners.size();
    for (size_t k = 0; k < n; ++k)
      CHECK(cross(points[corners[k]], points[corners[(k + 1) % n]], points[corners[(k + 2) % n]]) >
            0);
  }
}

TEST_CASE("a turned rectangle full of points has four corners") {
  for (int turn = 0; turn < 40; ++turn) {
    const double angle = 0.1 * turn, c = std::cos(angle), s = std::sin(angle);
    Points points;
    for (int x = 0; x <= 20; ++x)
      for (int y = 0; y <= 10; ++y) points.emplace_back(c * x - s * y, s * x + c * y);
    // the rounding error of coordinates near 20 is about 1e-15
    auto corners = outline(points, 1e-9);
    std::sort(corners.begin(), corners.end());
    CHECK(corners == std::vector<int>{0, 10, 220, 230});
  }
}

TEST_CASE("points on a line have two ends for any direction of the line") {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const double angle = random.uniform(0, 7);
    const Vector2d along = trial == 0   ? Vector2d(0, 1)
                           : trial == 1 ? Vector2d(1, 0)
                                        : Vector2d(std::cos(angle), std::sin(angle));
    Points points;
    for (int i = 0; i < 50; ++i) points.push_back(Vector2d(3, -2) + random.uniform(-1, 1) * along);
    points.push_back(Vector2d(3, -2) + 2 * along);
    points.push_back(Vector2d(3, -2) - 2 * along);
    auto ends = outline(points, 1e-9);
    std::sort(ends.begin(), ends.end());
    CHECK(ends == std::vector<int>{50, 51});
  }
}

TEST_CASE("no points give no outline, and one or many equal points give one corner") {
  CHECK(outline({}, 0).empty());
  CHECK(outline({{1, 2}}, 0).size() == 1);
  CHECK(outline(Points(5, Vector2d(1, 2)), 0).size() == 1);
  CHECK(outline({{1, 2}, {1, 2 + 1e-12}, {1 + 1e-12, 2}}, 1e-9).size() == 1);
}

TEST_CASE("omitted points of an outline are within the tolerance of it") {
  Random random(3);
  Points points;
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    points.emplace_back(std::cos(angle), 0.7 * std::sin(angle));
  }
  const double flat = 1e-3;
  const auto corners = outline(points, flat);
  CHECK(corners.size() < 100);
  for (const Vector2d& p : points) {
    double outside = 0;
    for (size_t k = 0; k < corners.size(); ++k) {
      const Vector2d &o = points[corners[k]], &a = points[corners[(k + 1) % corners.size()]];
      outside = std::max(outside, -cross(o, a, p) / (a - o).norm());
    }
    CHECK(outside <= flat);
  }
}

TEST_CASE("spread starts at the given point, keeps its distance, and respects its limit") {
  Random random(4);
  Points points;
  std::vector<int> others;
  for (int i = 0; i < 200; ++i) {
    points.emplace_back(random.uniform(), random.uniform());
    others.push_back(i);
  }
  const auto few = spread(points, 17, others, 0, 6);
  CHECK(few.size() == 6);
  CHECK(few[0] == 17);
  const auto apart = spread(points, 17, others, 0.3, 1000);
  for (size_t i = 0; i < apart.size(); ++i)
    for (size_t j = 0; j < i; ++j) CHECK((points[apart[i]] - points[apart[j]]).norm() > 0.3);
  // and no omitted point could have been kept
  for (const Vector2d& p : points)
    CHECK(std::any_of(apart.begin(), apart.end(),
                      [&](int i) { return (points[i] - p).norm() <= 0.3; }));
}
