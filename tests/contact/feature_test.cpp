// Features of contacts: correct for every shape, pose and order of bodies, and constant from step
// to step.
#include <doctest/doctest.h>

#include <map>
#include <set>

#include "clench/base/random.h"
#include "clench/contact/contact_set.h"
#include "clench/geometry/query/triangle.h"
#include "support/meshes.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

// distance of p, in the mesh's frame, from a feature of the mesh
double distance_to(const Mesh& mesh, const Feature& f, const Vector3d& p) {
  if (f.kind == Feature::vertex) return (p - mesh.vertices[f.first]).norm();
  if (f.kind == Feature::edge) {
    const Vector3d &a = mesh.vertices[f.first], &b = mesh.vertices[f.second];
    return segment_segment(p, p, a, b).distance;
  }
  return point_triangle(p, mesh.corners(f.first)).distance;
}

bool is_edge(const Mesh& mesh, const Feature& f) {
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (std::minmax(t[k], t[(k + 1) % 3]) == std::minmax(f.first, f.second)) return true;
  return false;
}

Pose above(double x, double y, double gap, double yaw = 0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), {x, y, gap}};
}

}  // namespace

TEST_CASE(
    "contacts lie on the features that they name, also for turned shapes and in either order") {
  Random random(9);
  int seen = 0;
  std::set<Feature::Kind> kinds;
  const auto cuboid = Shape::make(box(0.02, 0.03, 0.04));
  const auto round = Shape::make(ball(0.03));
  for (int n = 0; n < 400; ++n) {
    const auto& a = n % 2 ? cuboid : round;
    const auto& b = n % 3 ? cuboid : round;
    Pose X_AB = test::random_pose(random, 0.1);
    const Distance d = distance(*a, *b, X_AB);
    if (d.distance == 0) continue;
    // to within the threshold along the shortest path
    X_AB.position -= (d.p_b - d.p_a) * (1 - 5e-5 / d.distance);
    const auto touches = contact_set(*a, *b, X_AB, {.threshold = 1e-4});
    const auto swapped = contact_set(*b, *a, X_AB.inverse(), {.threshold = 1e-4});
    std::multiset<std::pair<Feature, Feature>> one, other;
    for (const Touch& t : touches) {
      ++seen;
      kinds.insert(t.feature_a.kind);
      CHECK(distance_to(a->mesh(), t.feature_a, t.p_a) < 1e-12);
      CHECK(distance_to(b->mesh(), t.feature_b, X_AB.inverse() * t.p_b) < 1e-12);
      if (t.feature_a.kind == Feature::edge) CHECK(is_edge(a->mesh(), t.feature_a));
      if (t.feature_b.kind == Feature::edge) CHECK(is_edge(b->mesh(), t.feature_b));
      one.insert({t.feature_a, t.feature_b});
    }
    for (const Touch& t : swapped) other.insert({t.feature_b, t.feature_a});
    if (touches.size() == 1) CHECK(one == other);
  }
  CHECK(seen > 300);
  CHECK(kinds.size() == 3);
}

TEST_CASE("a box that slides on a plate keeps the features of its contacts") {
  const auto plate = Shape::make(box(0.5, 0.5, 0.01));
  const auto cuboid = Shape::make(box(0.02, 0.03, 0.04));
  std::map<int, Vector3d> before;  // corner of the box -> contact point
  Random random(4);
  double x = 0.01, y = 0.02;
  for (int step = 0; step < 60; ++step) {
    const double height = 0.5 * 0.01 + 0.5 * 0.04 + random.uniform(2e-5, 8e-5);
    x += 1e-3, y -= 5e-4;
    std::map<int, Vector3d> now;
    for (const Touch& t : contact_set(*plate, *cuboid, above(x, y, height, 0.01 * step))) {
      REQUIRE(t.feature_b.kind == Feature::vertex);
      now[t.feature_b.first] = t.p_b;
    }
    REQUIRE(now.size() == 4);
    if (step > 0)
      for (const auto& [vertex, p] : now) {
        REQUIRE(before.contains(vertex));
        // one step, and a rotation by a hundredth of a radian about the center
        CHECK((p - before[vertex]).norm() < 1.6e-3);
      }
    before = now;
  }
}

TEST_CASE("contacts of crossed edges name the ends of the edges") {
  const auto cuboid = Shape::make(box(0.1, 0.1, 0.1));
  // both boxes rest on an edge, with the edges at right angles
  const double half = 0.05 * std::sqrt(2.0);
  const Eigen::Quaterniond on_x(Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitX()));
  const Eigen::Quaterniond on_y(Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitY()));
  const Pose X_A{on_x, Vector3d::Zero()}, X_B{on_y, {0.003, 0.004, 2 * half + 5e-5}};
  const auto touches = contact_set(*cuboid, *cuboid, X_A.inverse() * X_B);
  REQUIRE(touches.size() == 1);
  for (const Feature& f : {touches[0].feature_a, touches[0].feature_b}) {
    CHECK(f.kind == Feature::edge);
    CHECK(f.first < f.second);
    CHECK(is_edge(cuboid->mesh(), f));
  }
}
