#include <doctest/doctest.h>

#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/tree/tree.h"
#include "support/meshes.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

double highest(const Mesh& mesh, const Vector3d& center, const Vector3d& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) most = std::max(most, n.dot(mesh.vertices[v] - center));
  return most;
}

double highest(const BoundingPolytope& bounding_polytope, const Vector3d& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const PointBundle& points : bounding_polytope.corners)
    for (int i = 0; i < lane_count; ++i)
      most = std::max(most, n.dot(Vector3d(points.at[0][i], points.at[1][i], points.at[2][i])));
  return most;
}

// largest distance of the bounding_polytope from the mesh, as a fraction of the radius
double excess_of(const Mesh& mesh, Random& random) {
  const auto shape = Shape::make(mesh);
  const Vector3d center = Vector3d::Map(shape->tree().center());
  double most = 0;
  for (int i = 0; i < 300; ++i) {
    Vector3d n = random_direction(random);
    if (i < 3) n = Vector3d::Unit(i);
    const double excess =
        (highest(shape->tree().bounding_polytope(), n) - highest(mesh, center, n)) /
        std::max(shape->radius(), 1e-300);
    // the rounding bound of bounding_polytope.h
    CHECK(excess > -16 * 0x1p-24);
    most = std::max(most, excess);
  }
  return most;
}

}  // namespace

TEST_CASE("a bounding polytope contains its mesh, and fits it closely") {
  Random random(1);
  // three faces meet at most of the 128 corners: 66 faces, evenly around a ball, exceed it by 5 %
  // of its radius at the corners; if slightly uneven, by twice as much
  CHECK(excess_of(ball(1, 40, 80), random) < 0.12);
  CHECK(excess_of(potato(random, 1, 20), random) < 0.12);
  CHECK(excess_of(moved(scaled(ball(1, 12, 30), 1e-6), Pose::translation({1, 0, 0})), random) <
        0.12);
  // for few vertices it is their hull
  CHECK(excess_of(box(1, 2, 3), random) < 1e-6);
  CHECK(excess_of(potato(random, 1, 6), random) < 1e-6);
  CHECK(excess_of(soup(random, 30), random) < 1e-6);
}

TEST_CASE("a bounding polytope contains meshes without volume, area or size") {
  Random random(2);
  Mesh flat = ball(1, 20, 30), needle = flat, spot = flat;
  for (Vector3d& p : flat.vertices) p.z() = 0.3 * p.x();
  for (Vector3d& p : needle.vertices) p = p.x() * Vector3d(1, 2, 3);
  for (Vector3d& p : spot.vertices) p.setConstant(0.25);
  CHECK(excess_of(flat, random) < 0.12);
  CHECK(excess_of(needle, random) < 0.01);
  CHECK(excess_of(spot, random) == 0);
  Mesh slivers = soup(random, 200);
  for (Vector3d& p : slivers.vertices) p = p.cwiseProduct(Vector3d(1, 1e-3, 1e-7));
  CHECK(excess_of(slivers, random) < 0.12);
}

TEST_CASE("a reported separation is correct for any starting direction") {
  Random random(3);
  const std::vector<ShapePtr> shapes = {
      Shape::make(potato(random, 1, 12)), Shape::make(box(1, 0.2, 3)),
      Shape::make(soup(random, 80)),
      Shape::make(moved(ball(0.7, 12, 25), Pose::translation({100, 50, -30})))};
  int found = 0, beside = 0;
  for (int i = 0; i < 1500; ++i) {
    const Shape &a = *shapes[i % 4], &b = *shapes[i / 4 % 4];
    Pose X{random_turn(random), Vector3d::Zero()};
    X.position = a.center() - X.rotation * b.center() +
                 random.uniform(0, a.radius() + b.radius()) * random_direction(random);
    const double reach = i % 3 == 0 ? random.uniform(0, 0.3) : 0;
    Vector3d start = i % 2 ? random_direction(random) : Vector3d::Zero();
    if (i % 10 == 1) start = Vector3d(std::nan(""), 1e300, 0);
    const Placement placement(a, b, X);
    const Separation s = find_separation(placement.trees(), reach, start.data());
    const double exact = distance(a, b, X).distance;
    beside += exact > reach + 0.1 * (a.radius() + b.radius());
    if (!s.found) continue;
    ++found;
    CHECK(exact > reach);
    const Vector3d n = Vector3d::Map(s.along);
    CHECK(std::abs(n.norm() - 1) < 0x1p-14);
    const double gap = n.dot(X.position) -
                       highest(b.mesh(), Vector3d::Zero(), -(X.rotation.inverse() * n)) -
                       highest(a.mesh(), Vector3d::Zero(), n);
    // rounding errors at 100 m, the farthest coordinate
    CHECK(gap > reach - 1e-13);
  }
  // meshes that are not convex may interlock without a separating plane
  CHECK(beside > 200);
  CHECK(found > 0.9 * beside);
}

TEST_CASE("a cached direction changes no answer along a slow walk") {
  Random random(4);
  const auto a = Shape::make(potato(random, 1, 12)), b = Shape::make(potato(random, 0.6, 12));
  PairCache cache;
  Pose X{Eigen::Quaterniond::Identity(), {1.7, 0, 0}};
  int hits = 0, remembered = 0;
  for (int i = 0; i < 1500; ++i) {
    X = Pose{random_turn(random).slerp(0.99, X.rotation), X.position + random_point(random, 0.02)};
    X.position *= 1.85 / X.position.norm();
    const bool cold = colliding(*a, *b, X);
    CHECK(colliding(*a, *b, X, &cache) == cold);
    hits += cold;
    remembered += cache.separation.norm() > 0.5;
    const double limit = random.uniform(0, 0.2);
    CHECK(distance(*a, *b, X, limit, &cache).distance == distance(*a, *b, X, limit).distance);
    CHECK(pairs_within(*a, *b, X, limit).empty() == (distance(*a, *b, X).distance >= limit));
  }
  CHECK(hits > 50);
  CHECK(hits < 1450);
  CHECK(remembered > 1000);
}
