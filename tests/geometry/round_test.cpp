// Round solids, compared with brute-force searches over many of their points.
#include <doctest/doctest.h>

#include <numbers>

#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/round_gap.h"
#include "support/meshes.h"

namespace clench::test {

using Eigen::Vector3d;

// every kind, slender and flat
static std::vector<Round> solids() {
  return {Round::ball(0.4),
          Round::capsule_of(0.2, 0.7),
          Round::capsule_of(0.05, 1),
          Round::cylinder_of(0.3, 0.5),
          Round::cylinder_of(0.6, 0.02),
          Round::cylinder_of(0.05, 1.2),
          Round::ellipsoid_of({0.3, 0.4, 0.5}),
          Round::ellipsoid_of({0.7, 0.7, 0.03}),
          Round::ellipsoid_of({0.05, 0.04, 0.6})};
}

// A point of the surface in a random direction; for cylinders half of the points are on the caps.
static Vector3d skin_point(const Round& round, Random& random) {
  const Vector3d n = random_direction(random);
  if (round.kind != Round::cylinder) {
    Vector3d p = support(round, n);
    if (round.kind == Round::ellipsoid && random.uniform(0, 1) < 0.5)
      return round.radii.cwiseProduct(n);
    if (round.half > 0 && random.uniform(0, 1) < 0.5)
      p = Vector3d(0, 0, random.uniform(-round.half, round.half)) +
          round.radii.x() * Vector3d(n.x(), n.y(), 0).normalized();
    return p;
  }
  const double angle = random.uniform(0, 2 * std::numbers::pi), radius = round.radii.x();
  const Vector3d rim(radius * std::cos(angle), radius * std::sin(angle), 0);
  if (random.uniform(0, 1) < 0.5)
    return rim + Vector3d(0, 0, random.uniform(-round.half, round.half));
  return std::sqrt(random.uniform(0, 1)) * rim +
         Vector3d(0, 0, n.z() < 0 ? -round.half : round.half);
}

TEST_CASE("the nearest point of a round solid is on its surface, and no other point is nearer") {
  Random random(1);
  for (const Round& round : solids())
    for (int i = 0; i < 60; ++i) {
      const Vector3d p = random_point(random, 0.5);
      const NearSkin near = nearest(round, p);
      const Vector3d on = p - near.distance * near.normal;
      CAPTURE(round.kind);
      CAPTURE(p.transpose());
      CHECK(std::abs(nearest(round, on).distance) < 1e-12);
      CHECK(std::abs(near.normal.norm() - 1) < 1e-12);
      // the solid lies below its tangent plane there
      CHECK((support(round, near.normal) - on).dot(near.normal) < 1e-9);
      double least = 1e9;
      for (int k = 0; k < 300; ++k) least = std::min(least, (skin_point(round, random) - p).norm());
      CHECK(std::abs(near.distance) <= least + 1e-12);
    }
}

TEST_CASE(
    "the distance of a point outside a round solid equals that of the best separating plane, and "
    "is convex") {
  Random random(2);
  for (const Round& round : solids())
    for (int i = 0; i < 100; ++i) {
      const Vector3d p = random_point(random, 0.6), q = random_point(random, 0.6);
      const NearSkin at_p = nearest(round, p), at_q = nearest(round, q),
                     middle = nearest(round, 0.5 * (p + q));
      CHECK(middle.distance <= 0.5 * (at_p.distance + at_q.distance) + 1e-12);
      CHECK(at_q.distance >= at_p.distance + at_p.normal.dot(q - p) - 1e-12);
      for (int k = 0; k < 20; ++k) {
        const Vector3d n = random_direction(random);
        CHECK(at_p.distance >= n.dot(p - support(round, n)) - 1e-12);
      }
    }
}

TEST_CASE("among thousands of points of a triangle, none is nearer than the reported one") {
  Random random(3);
  for (const Round& solid : solids())
    for (int i = 0; i < 25; ++i) {
      const PlacedRound round{solid, random_pose(random, 0.5)};
      Corners c;
      for (Vector3d& corner : c) corner = random_point(random, i % 3 ? 0.7 : 0.1);
      if (i % 12 == 11) c[2] = c[1];
      const NearPlace found = nearest_on_triangle(round, c);
      double least = 1e9;
      constexpr int n = 60;
      for (int u = 0; u <= n; ++u)
        for (int v = 0; u + v <= n; ++v) {
          const Vector3d p = c[0] + (c[1] - c[0]) * u / n + (c[2] - c[0]) * v / n;
          least = std::min(least, round.nearest_to(p).distance);
        }
      CAPTURE(solid.kind);
      CAPTURE(i);
      // it is a point of the triangle
      CHECK(point_triangle(found.point, c).distance < 1e-9);
      CHECK(std::abs(round.nearest_to(found.point).distance - found.distance) < 1e-9);
      if (least > 0) CHECK(found.distance <= least + 1e-9);
      if (found.distance > 0) CHECK(least > 0);
      if (found.distance < 0) CHECK(least < 0.05);
    }
}

TEST_CASE("the gap of two round solids equals a search of many points, in either order") {
  Random random(4);
  int apart = 0, overlapping = 0;
  for (const Round& first : solids())
    for (const Round& second : solids())
      for (int i = 0; i < 12; ++i) {
        const Pose X = random_pose(random, 0.2);
        const PlacedRound a{first, X},
            b{second,
              X * Pose{random_turn(random), random.uniform(0.3, 1.4) * random_direction(random)}};
        const RoundGap found = gap_between(a, b), back = gap_between(b, a);
        CAPTURE(first.kind);
        CAPTURE(second.kind);
        CAPTURE(i);
        // points of b's surface, increasingly near to a: the best one, then others around it
        double least = 1e9;
        Vector3d best = b.center();
        for (int k = 0; k < 400; ++k) {
          const Vector3d p = b.X * skin_point(second, random);
          if (const double d = a.nearest_to(p).distance; d < least) least = d, best = p;
        }
        for (double size = 0.1; size > 1e-7; size *= 0.8)
          for (int k = 0; k < 8; ++k) {
            const Vector3d q = best + size * random_point(random, 0.5);
            const NearPlace skin = b.nearest_to(q);
            const Vector3d p = q - std::max(skin.distance, 0.0) * skin.normal;
            if (const double d = a.nearest_to(p).distance; d < least) least = d, best = p;
          }
        if (found.gap > 0) {
          ++apart;
          CHECK(found.gap <= least + 1e-9);
          CHECK(std::abs(found.gap - back.gap) < 1e-8);
          CHECK(std::abs((found.p_b - found.p_a).norm() - found.gap) < 1e-8);
          CHECK(std::abs(a.nearest_to(found.p_a).distance) < 1e-8);
          CHECK(std::abs(b.nearest_to(found.p_b).distance) < 1e-8);
          // a plane separates them
          CHECK(found.normal.dot(b.farthest(-found.normal) - a.farthest(found.normal)) >
                found.gap - 1e-7);
        } else {
          ++overlapping;
          CHECK(least < 1e-6);
          CHECK(back.gap < 1e-8);
        }
      }
  CHECK(apart > 200);
  CHECK(overlapping > 100);
}

// The mesh that represents a round solid.
static Mesh standing_for(const Round& round) {
  Mesh mesh = ball(1, 40, 80);
  for (Vector3d& p : mesh.vertices) p = support(round, p.normalized());
  return mesh;
}

TEST_CASE("round pieces of shapes follow their formulas, and the rest its triangles") {
  Random random(5);
  for (const Round& solid : {Round::capsule_of(0.2, 0.7), Round::cylinder_of(0.3, 0.5),
                             Round::ellipsoid_of({0.3, 0.4, 0.5})})
    for (int i = 0; i < 40; ++i) {
      const Pose X_SR = random_pose(random, 0.3);
      const Mesh round = moved(standing_for(solid), X_SR),
                 flat = moved(box(0.3, 0.2, 0.6), random_pose(random, 0.4));
      RoundPieces pieces;
      pieces.pieces.push_back({.solid = solid,
                               .X_SR = X_SR,
                               .first = 0,
                               .count = static_cast<int>(round.triangles.size())});
      const auto both = Shape::make(joined(round, flat), "both", {}, pieces);
      const auto other = Shape::make(moved(potato(random, 0.3), random_pose(random, 0.4)));
      const Pose X = random_pose(random, 1);
      const Distance found = distance(*both, *other, X);
      const Distance of_flat = distance(*Shape::make(flat), *other, X);
      const PlacedRound placed{solid, X.inverse() * X_SR};
      double of_round = 1e9;
      for (const Triangle& t : other->mesh().triangles)
        of_round = std::min(of_round, nearest_on_triangle(placed, {other->mesh().vertices[t[0]],
                                                                   other->mesh().vertices[t[1]],
                                                                   other->mesh().vertices[t[2]]})
                                          .distance);
      const bool inside = contains(*other, placed.center());
      const double expected = inside ? 0 : std::max(0.0, std::min(of_flat.distance, of_round));
      CHECK(std::abs(found.distance - expected) < 1e-9);
      CHECK((found.distance == 0) == colliding(*both, *other, X));
      const Distance back = distance(*other, *both, X.inverse());
      CHECK(std::abs(back.distance - found.distance) < 1e-9);
      if (found.distance > 0) {
        CHECK(std::abs((found.p_a - found.p_b).norm() - found.distance) < 1e-9);
        CHECK((X * back.p_a - found.p_b).norm() < 1e-6);
        const double limit = found.distance * random.uniform(0.5, 1.5);
        const Distance limited = distance(*both, *other, X, limit);
        CHECK((limited.triangle_a >= 0) == (found.distance < limit));
      }
    }
}

}  // namespace clench::test
