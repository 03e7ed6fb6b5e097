#include <doctest/doctest.h>

#include <algorithm>

#include "clench/base/error.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/query/triangle.h"
#include "support/meshes.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

bool surfaces_meet(const Shape& a, const Shape& b, const Pose& X_AB) {
  for (int s = 0; a.has_triangle(s); ++s)
    for (int t = 0; b.has_triangle(t); ++t)
      if (triangles_meet(a.mesh().corners(s), corners_at(b, X_AB, t))) return true;
  return false;
}

// whether any vertex of one mesh is inside the other solid
bool one_holds_the_other(const Shape& a, const Shape& b, const Pose& X_AB) {
  if (a.closed())
    for (const Vector3d& p : b.mesh().vertices)
      if (std::abs(winding(a.mesh(), X_AB * p)) > 0.5) return true;
  if (b.closed())
    for (const Vector3d& p : a.mesh().vertices)
      if (std::abs(winding(b.mesh(), X_AB.inverse() * p)) > 0.5) return true;
  return false;
}

void check_against_all_pairs(const Shape& a, const Shape& b, Random& random, double reach,
                             int poses) {
  int hits = 0;
  for (int i = 0; i < poses; ++i) {
    const Pose X = random_pose(random, reach);
    const bool expected = surfaces_meet(a, b, X) || one_holds_the_other(a, b, X);
    CHECK(colliding(a, b, X) == expected);
    CHECK(colliding(b, a, X.inverse()) == expected);
    hits += expected;
  }
  // both answers occur
  CHECK(hits > 0);
  CHECK(hits < poses);
}

}  // namespace

TEST_CASE("collision of random soups with degenerate triangles equals a search of all pairs") {
  Random random(1);
  const auto a = Shape::make(soup(random, 45)), b = Shape::make(soup(random, 30));
  check_against_all_pairs(*a, *b, random, 1.2, 100);
}

TEST_CASE("collision of closed bodies equals a search of all pairs and of inner vertices") {
  Random random(2);
  const auto a = Shape::make(potato(random, 1, 6)), b = Shape::make(potato(random, 0.4, 4));
  check_against_all_pairs(*a, *b, random, 1.5, 100);
}

TEST_CASE("a body inside another collides, in either order, also with inverted faces") {
  Random random(3);
  const auto big = Shape::make(ball(2)), small = Shape::make(box(0.5, 0.5, 0.5)),
             inward = Shape::make(inverted(ball(2)));
  for (int i = 0; i < 50; ++i) {
    const Pose X = random_pose(random, 0.7);
    CHECK(colliding(*big, *small, X));
    CHECK(colliding(*small, *big, X.inverse()));
    CHECK(colliding(*inward, *small, X));
  }
  CHECK(colliding(*big, *big, Pose()));
}

TEST_CASE("an open body contains nothing, but can be contained") {
  Mesh cup = box(1, 1, 1);
  cup.triangles.resize(2);
  cup.triangles.push_back({0, 1, 5});
  const auto open = Shape::make(cup), small = Shape::make(box(0.1, 0.1, 0.1)),
             big = Shape::make(box(3, 3, 3));
  CHECK_FALSE(colliding(*open, *small, Pose()));
  CHECK_FALSE(colliding(*small, *open, Pose()));
  CHECK(colliding(*open, *big, Pose()));
  CHECK(colliding(*big, *open, Pose()));
}

TEST_CASE("any part inside is a collision, and the cavity of a shell is outside") {
  const Mesh bead = box(0.1, 0.1, 0.1);
  const auto far_and_near = Shape::make(joined(moved(bead, Pose::translation({9, 0, 0})), bead));
  const auto outside = Shape::make(joined(moved(bead, Pose::translation({9, 0, 0})),
                                          moved(bead, Pose::translation({0, -9, 0}))));
  const auto big = Shape::make(ball(1));
  CHECK(colliding(*big, *far_and_near, Pose()));
  CHECK(colliding(*far_and_near, *big, Pose()));
  CHECK_FALSE(colliding(*big, *outside, Pose()));

  const auto shell = Shape::make(joined(ball(2), inverted(ball(1))));
  const auto small = Shape::make(bead);
  CHECK_FALSE(colliding(*shell, *small, Pose()));
  CHECK(colliding(*shell, *small, Pose::translation({1.5, 0, 0})));
  CHECK_FALSE(colliding(*shell, *small, Pose::translation({2.5, 0, 0})));
}

TEST_CASE("touching is a collision: faces, edges and corners of boxes at exact coordinates") {
  const auto a = Shape::make(box(1, 1, 1));
  for (const Vector3d& p : {Vector3d(1, 0, 0), Vector3d(1, 0.25, -0.5), Vector3d(1, 1, 0),
                            Vector3d(1, 1, 1), Vector3d(0, -1, 0.125)})
    CHECK(colliding(*a, *a, Pose::translation(p)));
  for (const Vector3d& p :
       {Vector3d(1 + 1e-9, 0, 0), Vector3d(1 + 1e-9, 1, 0), Vector3d(0, 0, -1 - 1e-9)})
    CHECK_FALSE(colliding(*a, *a, Pose::translation(p)));
}

TEST_CASE("cached data change no answer, even if they belong to other shapes") {
  Random random(4);
  const auto a = Shape::make(potato(random, 1, 8)), b = Shape::make(potato(random, 0.6, 6));
  PairCache cache{.hit_a = 1 << 30, .hit_b = -7};
  Pose X = random_pose(random, 1.5);
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    X = Pose{random_turn(random).slerp(0.9, X.rotation), X.position + random_point(random, 0.1)};
    if (X.position.norm() > 2) X.position *= 0.7;
    const bool cold = colliding(*a, *b, X);
    CHECK(colliding(*a, *b, X, &cache) == cold);
    hits += cold;
  }
  CHECK(hits > 20);
  CHECK(hits < 380);
}

TEST_CASE("real meshes: collision equals a search of all pairs") {
  REQUIRE_SHARED();
  Random random(5);
  // the 250 triangles nearest to the first corner, moved to the origin, because the search of all
  // pairs is slow
  const auto patch = [](const char* name) {
    Mesh mesh = read_obj(shared() / "data" / "ycb" / name);
    const Vector3d start = mesh.vertices[mesh.triangles[0][0]];
    for (Vector3d& p : mesh.vertices) p -= start;
    const auto distance = [&](const Triangle& t) { return mesh.vertices[t[0]].norm(); };
    std::nth_element(
        mesh.triangles.begin(), mesh.triangles.begin() + 250, mesh.triangles.end(),
        [&](const Triangle& s, const Triangle& t) { return distance(s) < distance(t); });
    mesh.triangles.resize(250);
    return Shape::make(mesh, name);
  };
  const auto banana = patch("011_banana.obj"), hammer = patch("048_hammer.obj");
  check_against_all_pairs(*banana, *hammer, random, 0.02, 20);
}

TEST_CASE("an invalid pose is rejected") {
  const auto a = Shape::make(box(1, 1, 1));
  CHECK_THROWS_WITH_AS(colliding(*a, *a, Pose{Eigen::Quaterniond(0, 0, 0, 0), {0, 0, 0}}),
                       "geometry query: pose: expected a unit quaternion, got (0, 0, 0, 0)", Error);
  CHECK_THROWS_WITH_AS(colliding(*a, *a, Pose::translation({0, std::nan(""), 1})),
                       "geometry query: position of the pose must be finite and within 1e+30 [m], "
                       "got (0, nan, 1)",
                       Error);
  CHECK_THROWS_AS(colliding(*a, *a, Pose{Eigen::Quaterniond(std::nan(""), 0, 0, 0), {0, 0, 0}}),
                  Error);
  CHECK_FALSE(colliding(*a, *a, Pose::translation({1e29, 0, 0})));
}
