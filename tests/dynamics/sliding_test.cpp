#include "clench/dynamics/contact/sliding.h"

#include <algorithm>

#include "clench/base/random.h"
#include "clench/dynamics/contact/manifolds.h"
#include "support/meshes.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

// a slab of 1 x 0.6 x 0.1 m, and a body on it
struct Pair {
  World world;
  Manifold manifold;
  Id<Body> slab, mover;

  Pair(bool slab_first, const Mesh& mesh, const Pose& X, const Mesh& below = box(1, 0.6, 0.1)) {
    const auto add = [&](const char* name, const Mesh& m, const Pose& at) {
      return world.add_body(body_spec(name, m), BodyKind::object, at);
    };
    if (slab_first) slab = add("slab", below, {});
    mover = add("mover", mesh, X);
    if (!slab_first) slab = add("slab", below, {});
    manifold = fresh();
  }
  Manifold fresh() {
    Manifold out;
    out.a = std::min(slab, mover), out.b = std::max(slab, mover);
    measure(world, out);
    return out;
  }
};

// distance of a point of one manifold from the nearest point of the other
double apart(const ManifoldPoint& point, const Manifold& other, bool of_a) {
  double out = 1;
  for (const ManifoldPoint& p : other.points)
    out = std::min(out, of_a ? (p.p_a - point.p_a).norm() : (p.p_b - point.p_b).norm());
  return out;
}

const Mesh block = box(0.06, 0.06, 0.04);

}  // namespace

TEST_CASE("contacts of corners that slide over a face equal newly computed contacts") {
  for (const bool slab_first : {true, false}) {
    int slid = 0;
    Pair pair(slab_first, block, Pose::translation({0.1, 0.05, 0.07 + 3e-5}));
    REQUIRE(pair.manifold.points.size() == 4);
    Random random(7);
    for (int i = 0; i < 400; ++i) {
      const double turn = random.uniform(-0.3, 0.3), tilt = random.uniform(-1e-3, 1e-3);
      const Pose X{Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(tilt, Vector3d::UnitX())),
                   {random.uniform(-0.1, 0.5), random.uniform(-0.3, 0.3),
                    0.07 + random.uniform(1e-5, 9e-5)}};
      pair.world.set_pose(pair.mover, X);
      Manifold followed = pair.manifold;
      if (!follow_sliding(pair.world, followed)) continue;
      ++slid;
      const Manifold fresh = pair.fresh();
      REQUIRE(fresh.points.size() == followed.points.size());
      CHECK(fresh.X_AB == followed.X_AB);
      // coordinates of some meters have rounding errors of 1e-15
      CHECK(std::abs(fresh.clearance - followed.clearance) < 1e-14);
      for (const ManifoldPoint& p : fresh.points) {
        for (const bool of_a : {true, false}) CHECK(apart(p, followed, of_a) < 1e-14);
        CHECK((p.normal - followed.points[0].normal).norm() < 1e-14);
      }
    }
    CHECK(slid > 10);
  }
}

TEST_CASE(
    "following rejects motions that may create other contacts, and leaves the manifold unchanged") {
  Pair pair(true, block, Pose::translation({0.1, 0.05, 0.07 + 3e-5}));
  const auto at = [&](const Vector3d& p) { pair.world.set_pose(pair.mover, Pose::translation(p)); };
  SUBCASE("over the edge") { at({0.49, 0.05, 0.07 + 3e-5}); }
  SUBCASE("lifted") { at({0.1, 0.05, 0.07 + 2e-4}); }
  SUBCASE("overlapping") { at({0.1, 0.05, 0.07 - 1e-5}); }
  SUBCASE("smaller threshold") { pair.world.set_contact_threshold(2e-5); }
  SUBCASE("soft body") { pair.world.set_elastic_modulus(pair.mover, 1e6); }
  SUBCASE("on another triangle") { at({-0.3, 0.25, 0.07 + 3e-5}); }
  SUBCASE("one corner leaves, another approaches") {
    pair.world.set_pose(pair.mover, {Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Vector3d::UnitX())),
                                     {0.1, 0.05, 0.0703}});
  }
  const Manifold before = pair.manifold;
  CHECK_FALSE(follow_sliding(pair.world, pair.manifold));
  CHECK(pair.manifold.X_AB == before.X_AB);
  for (size_t i = 0; i < before.points.size(); ++i)
    CHECK(pair.manifold.points[i].p_a == before.points[i].p_a);
}

TEST_CASE("following rejects a motion that brings another foot near the face") {
  // legs of a stool: the fourth is 0.15 mm shorter
  Mesh stool;
  for (const double x : {-0.05, 0.05})
    for (const double y : {-0.05, 0.05})
      stool = joined(stool, moved(box(0.01, 0.01, 0.1),
                                  Pose::translation({x, y, x > 0 && y > 0 ? 0.05015 : 0.05})));
  Pair pair(true, stool, Pose::translation({0, 0.1, 0.05 + 3e-5}));
  const size_t three = pair.manifold.points.size();
  REQUIRE(three > 0);
  pair.world.set_pose(pair.mover, Pose::translation({0.01, 0.11, 0.05 + 6e-5}));
  Manifold followed = pair.manifold;
  CHECK(follow_sliding(pair.world, followed));
  CHECK(followed.points.size() == pair.fresh().points.size());
  pair.world.set_pose(pair.mover,
                      {Eigen::Quaterniond(Eigen::AngleAxisd(8e-4, Vector3d(-1, 1, 0).normalized())),
                       {0, 0.1, 0.05 + 9e-5}});
  followed = pair.manifold;
  CHECK_FALSE(follow_sliding(pair.world, followed));
}

TEST_CASE("following requires convex bodies") {
  // a trough: the block may touch its walls
  const Mesh trough =
      joined(box(1, 0.6, 0.1), moved(box(1, 0.1, 0.3), Pose::translation({0, 0.25, 0.2})));
  Pair pair(true, block, Pose::translation({0.1, -0.1, 0.07 + 3e-5}), trough);
  REQUIRE(pair.manifold.points.size() == 4);
  CHECK_FALSE(follow_sliding(pair.world, pair.manifold));
}
