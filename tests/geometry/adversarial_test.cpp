#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"
#include "clench/geometry/tree/triangle_lanes.h"
#include "geometry/one_box.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

constexpr double beyond_all = std::numeric_limits<double>::infinity();

// compares every query on a pair bit-exactly with a search of all pairs of triangles, moved by the
// same arithmetic
void check_all_queries(const Shape& a, const Shape& b, const Pose& X, double threshold) {
  const Eigen::Matrix3d R = X.rotation.normalized().toRotationMatrix();
  double least = beyond_all;
  std::vector<std::pair<int, int>> within;
  for (int s = 0; a.has_triangle(s); ++s)
    for (int t = 0; b.has_triangle(t); ++t) {
      auto moved = b.mesh().corners(t);
      for (auto& p : moved) p = R * p + X.position;
      const double d = triangle_triangle(a.mesh().corners(s), moved).distance;
      least = std::min(least, d);
      if (d < threshold) within.emplace_back(s, t);
    }
  const Distance d = distance(a, b, X);
  const bool held = d.distance == 0 && (d.triangle_a < 0 || d.triangle_b < 0);
  CHECK((d.distance == least || held));
  CHECK(colliding(a, b, X) == (d.distance == 0));
  const auto found = pairs_within(a, b, X, threshold);
  REQUIRE(found.size() == within.size());
  for (size_t i = 0; i < found.size(); ++i)
    CHECK(std::pair(found[i].triangle_a, found[i].triangle_b) == within[i]);
  const Vector3d p = X.position;
  least = beyond_all;
  for (int s = 0; a.has_triangle(s); ++s)
    least = std::min(least, point_triangle(p, a.mesh().corners(s)).distance);
  CHECK(closest_point(a, p).distance == least);
}

// needles and shards: each triangle a million times as long as wide, or without any area
Mesh slivers(Random& random, int count) {
  Mesh mesh = soup(random, count);
  for (int i = 0; i < count; ++i) {
    const Vector3d p = mesh.vertices[3 * i], q = mesh.vertices[3 * i + 1];
    mesh.vertices[3 * i + 2] = p + random.uniform() * (q - p) + random_point(random, i % 3 * 1e-7);
  }
  return mesh;
}

// a sheet of n x n squares, all in one plane
Mesh sheet(int n, double size) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.vertices.push_back({i * size / n, j * size / n, 0});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int k = i * (n + 1) + j;
      mesh.triangles.push_back({k, k + n + 1, k + n + 2});
      mesh.triangles.push_back({k, k + n + 2, k + 1});
    }
  return mesh;
}

Mesh twice(const Mesh& mesh) { return joined(mesh, mesh); }

Mesh half_of(Mesh mesh) {
  mesh.triangles.resize(mesh.triangles.size() / 2);
  return mesh;
}

}  // namespace

TEST_CASE(
    "slivers and doubled, open and flat meshes: every query equals a search of all pairs, "
    "bit-exactly") {
  Random random(1);
  const std::vector<Mesh> meshes = {slivers(random, 40), twice(potato(random, 0.5, 4)),
                                    half_of(potato(random, 0.6, 6)), sheet(4, 1), soup(random, 40)};
  for (const Mesh& first : meshes)
    for (const Mesh& second : meshes) {
      const auto a = Shape::make(first), b = Shape::make(second);
      for (int i = 0; i < 6; ++i) check_all_queries(*a, *b, random_pose(random, 1.3), 0.1);
    }
}

TEST_CASE("meshes of a micrometer, a kilometer away, and of very different sizes: the same") {
  Random random(2);
  const Mesh mesh = potato(random, 1, 5);
  struct Case {
    double size_a, size_b, offset;
  };
  for (const auto& c : {Case{1e-6, 1e-6, 0},
                        {1, 1, 1000},
                        {1, 1e-4, 0},
                        {1e-3, 1e3, 0},
                        {1e-9, 2e-9, 0},
                        {1e8, 1e7, 0},
                        {1, 1, 1e7},
                        {1e-6, 1e-6, 1}}) {
    const Vector3d away = c.offset * Vector3d(1, -2, 0.5);
    const auto a = Shape::make(moved(scaled(mesh, c.size_a), Pose::translation(away))),
               b = Shape::make(scaled(mesh, c.size_b));
    for (int i = 0; i < 6; ++i) {
      Pose X = random_pose(random, 1.5 * std::max(c.size_a, c.size_b));
      X.position += away;
      check_all_queries(*a, *b, X, 0.1 * std::min(c.size_a, c.size_b));
    }
  }
}

TEST_CASE("distances of bodies far apart for their size are bit-exact as well") {
  Random random(3);
  const auto a = Shape::make(potato(random, 0.1, 5)), b = Shape::make(potato(random, 0.05, 5));
  for (const double far : {10.0, 1e3, 1e6, 1e12, 1e29})
    check_all_queries(*a, *b, {random_turn(random), far * random_direction(random)}, 0.1);
}

TEST_CASE("sheets of thousands of coplanar triangles collide, or have a tiny distance") {
  const auto a = Shape::make(sheet(40, 1)), b = Shape::make(sheet(12, 0.2));
  CHECK(colliding(*a, *b, Pose::translation({0.3, 0.3, 0})));
  CHECK(distance(*a, *b, Pose::translation({0.3, 0.3, 0})).distance == 0);
  const Pose above = Pose::translation({0.3, 0.3, 1e-7});
  CHECK_FALSE(colliding(*a, *b, above));
  CHECK(distance(*a, *b, above).distance == 1e-7);
  // next to each other in one plane
  CHECK(std::abs(distance(*a, *b, Pose::translation({1.25, 0.1, 0})).distance - 0.25) < 1e-15);
  CHECK_FALSE(colliding(*a, *b, Pose::translation({1.0000001, 0.1, 0})));
}

TEST_CASE("a cache kept over long walks changes no verdict and no distance") {
  Random random(4);
  const auto a = Shape::make(potato(random)), b = Shape::make(potato(random, 0.5));
  for (const double pace : {1e-3, 0.02, 0.3}) {
    PairCache cache;
    Pose X{random_turn(random), {2, 0, 0}};
    for (int i = 0; i < 300; ++i) {
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond::Identity().slerp(pace, random_turn(random));
      X = {turn * X.rotation, X.position + random_point(random, pace)};
      if (X.position.norm() > 2.2) X.position *= 0.8;
      const double limit = i % 3 == 0 ? beyond_all : random.uniform(0, 1);
      const double cold = distance(*a, *b, X, limit).distance;
      if (i % 2 == 0) CHECK(colliding(*a, *b, X, &cache) == (cold == 0));
      CHECK(distance(*a, *b, X, limit, &cache).distance == cold);
      // a cache used for other shapes is ignored
      if (i % 50 == 49)
        CHECK(colliding(*b, *a, X.inverse(), &cache) == colliding(*b, *a, X.inverse()));
    }
  }
}

namespace {

// eight random boxes and eight random triangles, as stored in a tree
void fill(Random& random, BoxBundle& boxes, TriangleBundle& triangles) {
  for (int i = 0; i < 8; ++i) {
    const Eigen::Matrix3d axes = random_turn(random).toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
      for (int m = 0; m < 3; ++m) boxes.axes[3 * k + m][i] = static_cast<float>(axes(m, k));
      boxes.center[k][i] = static_cast<float>(random.normal());
      boxes.half[k][i] = static_cast<float>(random.uniform(0, 0.5));
    }
    boxes.size[i] = 1;
    for (auto& row : triangles.corners) row[i] = static_cast<float>(random.normal());
  }
}

template <int Width>
std::vector<float> results_at(const BoxBundle& boxes, const TriangleBundle& one,
                              const TriangleBundle& two) {
  using F = Lanes<float, Width>;
  std::vector<float> out;
  const auto add = [&](const F& x) {
    float values[8];
    x.store(values);
    out.insert(out.end(), values, values + 8);
  };
  const auto eight = load_boxes<F>(boxes);
  for (int i = 0; i < 8; ++i) {
    const auto box = one_box<float>(boxes, i);
    add(box_gaps(eight, box)), add(axis_gaps(eight, box)), add(edge_gaps(eight, box));
  }
  const F gaps = squared_point_gaps(eight, {0.1f, 0.2f, 0.3f});
  add(gaps);
  add(select((gaps > 1.0f) & (gaps <= 4.0f), gaps, F::all(-1)));
  out.push_back(static_cast<float>((gaps >= 2.0f).set()));
  out.push_back(min_of(gaps));
  const auto a = load_triangles<F>(one), b = load_triangles<F>(two);
  const auto near = near_bounds(a, b);
  add(near.low), add(near.high), add(near.way.x), add(near.way.y), add(near.way.z);
  const auto point = point_bounds(a, {0.1f, 0.2f, 0.3f});
  add(point.height), add(point.squared_high);
  out.push_back(static_cast<float>(edges_within_reach(a, b, 0.1f, 0xff)));
  return out;
}

}  // namespace

TEST_CASE("vectors of one, two and four numbers give bit-identical results") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    BoxBundle boxes;
    TriangleBundle one, two;
    fill(random, boxes, one), fill(random, boxes, two);
    const auto narrow = results_at<1>(boxes, one, two);
    CHECK(results_at<2>(boxes, one, two) == narrow);
    CHECK(results_at<4>(boxes, one, two) == narrow);
  }
}

TEST_CASE("min_of returns the minimum of eight lanes") {
  const float some[8] = {3, 5, 7, 2, 3, 9, 2.5f, 3};
  CHECK(min_of(Lanes<float, 4>::load(some)) == 2);
}

TEST_CASE("bounds of boxes and triangles in single precision bracket the exact distances") {
  Random random(6);
  // rounding bound of precision.h, for coordinates below 8
  const double slack = 64 * 0x1p-24 * 8;
  for (int i = 0; i < 200; ++i) {
    BoxBundle boxes;
    TriangleBundle one, two;
    fill(random, boxes, one), fill(random, boxes, two);
    using F = Lanes<float, 4>;
    const auto near = near_bounds(load_triangles<F>(one), load_triangles<F>(two));
    float low[8], high[8];
    near.low.store(low), near.high.store(high);
    const unsigned within =
        edges_within_reach(load_triangles<F>(one), load_triangles<F>(two), 0.5f, 0xff);
    for (int lane = 0; lane < 8; ++lane) {
      Corners a, b;
      for (int k = 0; k < 3; ++k)
        for (int m = 0; m < 3; ++m)
          a[k][m] = one.corners[3 * k + m][lane], b[k][m] = two.corners[3 * k + m][lane];
      const double exact = triangle_triangle(a, b).distance;
      if (!std::isnan(low[lane])) CHECK(low[lane] <= exact + slack);
      CHECK(high[lane] >= exact - slack);
      if (exact < 0.5 - slack) CHECK((within >> lane & 1) == 1);
    }
  }
}
