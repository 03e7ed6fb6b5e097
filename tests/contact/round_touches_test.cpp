// Contacts of round solids, compared with contact points from drawings.
#include <doctest/doctest.h>

#include <numbers>

#include "clench/contact/contact_set.h"
#include "support/meshes.h"

namespace clench::test {

using Eigen::Vector3d;

// A coarse prism or ball; exact contacts must follow from the formula of the round solid.
static ShapePtr solid(const Round& round, const Pose& X = {}) {
  Mesh mesh = ball(1, 6, 12);
  for (Vector3d& p : mesh.vertices) p = X * support(round, p.normalized());
  RoundPieces rounds;
  rounds.pieces.push_back(
      {.solid = round, .X_SR = X, .first = 0, .count = static_cast<int>(mesh.triangles.size())});
  return Shape::make(std::move(mesh), "solid", {}, rounds);
}

static ShapePtr slab() {
  return Shape::make(moved(box(1, 1, 0.1), Pose::translation({0, 0, -0.05})));
}

static constexpr double can_gap = 4e-5;

static Pose lying(double height) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX())),
          {0.013, 0.007, height + can_gap}};
}

TEST_CASE(
    "a cylinder on its side touches a slab at the ends of a line, and on its cap along the rim") {
  const auto can = solid(Round::cylinder_of(0.02, 0.06));
  const auto along = contact_set(*slab(), *can, lying(0.02));
  CHECK(along.size() == 2);
  for (const Touch& touch : along) {
    CHECK(std::abs(touch.gap - can_gap) < 1e-12);
    CHECK((touch.normal_b - Vector3d::UnitZ()).norm() < 1e-12);
    CHECK(std::abs(std::abs(touch.p_a.y() - 0.007) - 0.03) < 1e-9);
    CHECK(touch.feature_b == Feature{Feature::round, 0, -1});
  }
  const auto upright = contact_set(*slab(), *can, Pose::translation({0.1, 0, 0.03 + can_gap}));
  CHECK(upright.size() >= 3);
  Vector3d middle = Vector3d::Zero();
  for (const Touch& touch : upright) {
    CHECK(std::abs((touch.p_a - Vector3d(0.1, 0, 0)).norm() - 0.02) < 1e-9);
    middle += touch.p_a / static_cast<double>(upright.size());
  }
  CHECK((middle - Vector3d(0.1, 0, 0)).norm() < 1e-3);
  // tilted, at one point of the rim
  const Pose tilt = Pose::turn(0.3, Vector3d::UnitY());
  const auto corner = contact_set(
      *slab(), *can,
      Pose::translation({0, 0, 0.03 * std::cos(0.3) + 0.02 * std::sin(0.3) + can_gap}) * tilt);
  CHECK(corner.size() == 1);
}

TEST_CASE(
    "the normal of a ball at an edge of a box points away from the edge, and over the diagonal of "
    "a face along the face normal") {
  const auto tip = solid(Round::ball(0.01));
  // beyond the slab's edge x = 0.5, on the line at 30 degrees
  const Vector3d outward(std::sin(0.5), 0, std::cos(0.5));
  const auto edge = contact_set(
      *slab(), *tip, Pose::translation(Vector3d(0.5, 0.02, 0) + (0.01 + can_gap) * outward));
  REQUIRE(edge.size() == 1);
  CHECK((edge[0].normal_b - outward).norm() < 1e-9);
  CHECK(edge[0].feature_a.kind == Feature::edge);
  // the slab's top is divided along a diagonal
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-0.4, 0.4),
                 y = x + random.uniform(-1, 1) * (i % 2 ? 1e-12 : 1e-3);
    for (const double side : {1.0, -1.0}) {
      const auto face =
          contact_set(*slab(), *tip, Pose::translation({x, side * y, 0.01 + can_gap}));
      CHECK(face.size() == 1);
      CHECK((face.at(0).normal_b - Vector3d::UnitZ()).norm() < 1e-9);
      CHECK(std::abs(face.at(0).gap - can_gap) < 1e-12);
    }
  }
}

TEST_CASE(
    "a ball in a corner of two boxes touches both, and a cylinder across two rails touches both "
    "rails") {
  const auto ball_ = solid(Round::ball(0.02));
  Mesh corner = joined(moved(box(0.2, 0.2, 0.1), Pose::translation({0, 0, -0.05})),
                       moved(box(0.1, 0.2, 0.2), Pose::translation({-0.05, 0, 0})));
  const auto touches = contact_set(*Shape::make(corner), *ball_,
                                   Pose::translation({0.02 + can_gap, 0, 0.02 + can_gap}));
  CHECK(touches.size() == 2);
  const auto can = solid(Round::cylinder_of(0.02, 0.2));
  const auto rails =
      Shape::make(joined(moved(box(0.2, 0.002, 0.1), Pose::translation({0, -0.05, -0.05})),
                         moved(box(0.2, 0.002, 0.1), Pose::translation({0, 0.05, -0.05}))));
  const auto across = contact_set(*rails, *can, lying(0.02));
  CHECK(across.size() == 2);
  double low = 1, high = -1;
  for (const Touch& touch : across)
    low = std::min(low, touch.p_a.y()), high = std::max(high, touch.p_a.y());
  CHECK(low == doctest::Approx(-0.051));
  CHECK(high == doctest::Approx(0.051));
}

TEST_CASE("stacked cans touch along the outline of the overlap of their caps") {
  const auto can = solid(Round::cylinder_of(0.03, 0.1));
  const double aside = 0.02, across = std::sqrt(0.03 * 0.03 - aside * aside / 4);
  const auto touches = contact_set(*can, *can, Pose::translation({aside, 0, 0.1 + can_gap}));
  CHECK(touches.size() >= 4);
  Vector3d low = Vector3d::Constant(1), high = -low;
  for (const Touch& touch : touches) {
    CHECK(std::abs(touch.gap - can_gap) < 1e-9);
    CHECK((touch.normal_b - Vector3d::UnitZ()).norm() < 1e-9);
    low = low.cwiseMin(touch.p_a), high = high.cwiseMax(touch.p_a);
  }
  CHECK(std::abs(high.y() - across) < 1e-6);
  CHECK(std::abs(low.y() + across) < 1e-6);
  // an outline of more than eight points is reduced to eight
  CHECK(low.x() < -0.007);
  CHECK(high.x() > 0.027);
  // crossed on their sides: one point; side by side: the ends of the shared line
  const auto crossed =
      contact_set(*can, *can,
                  Pose{Eigen::Quaterniond(Eigen::AngleAxisd(1.2, Vector3d::UnitX())),
                       {0.06 + can_gap, 0.01, 0}});
  CHECK(crossed.size() == 1);
  const auto beside = contact_set(*can, *can, Pose::translation({0.06 + can_gap, 0, 0.04}));
  REQUIRE(beside.size() == 2);
  CHECK(std::abs(std::abs(beside[0].p_a.z() - beside[1].p_a.z()) - 0.06) < 1e-6);
}

TEST_CASE("contacts of round pieces do not depend on the order of shapes or on their position") {
  Random random(9);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Round round = i % 3 == 0   ? Round::capsule_of(0.1, 0.5)
                        : i % 3 == 1 ? Round::cylinder_of(0.2, 0.3)
                                     : Round::ellipsoid_of({0.1, 0.2, 0.3});
    const auto a = solid(round), b = Shape::make(potato(random, 0.4));
    // moved together until they touch
    Pose X = random_pose(random, 1);
    const Distance apart = distance(*a, *b, X);
    if (apart.distance == 0) continue;
    X.position -= (apart.distance - can_gap) / apart.distance * (apart.p_b - apart.p_a);
    const auto touches = contact_set(*a, *b, X);
    REQUIRE(!touches.empty());
    ++found;
    double least = 1;
    for (const Touch& touch : touches) {
      least = std::min(least, touch.gap);
      CHECK(std::abs((touch.p_b - touch.p_a).norm() - touch.gap) < 1e-9);
      CHECK(std::abs(nearest(round, touch.p_a).distance) < 1e-9);
      CHECK(closest_point(*b, X.inverse() * touch.p_b).distance < 1e-9);
    }
    CHECK(std::abs(least - can_gap) < 1e-9);
    const auto back = contact_set(*b, *a, X.inverse());
    CHECK(back.size() == touches.size());
    const Pose away = random_pose(random, 2);
    const auto turned = contact_set(*solid(round, away), *b, away * X);
    CHECK(turned.size() == touches.size());
  }
  CHECK(found > 150);
}

}  // namespace clench::test
