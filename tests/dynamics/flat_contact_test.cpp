#include "clench/dynamics/contact/flat_contact.h"

#include <algorithm>

#include "clench/base/random.h"
#include "clench/dynamics/contact/manifolds.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

struct Pair {
  World world;
  Manifold manifold;
};

Manifold manifold_of(Id<Body> a, Id<Body> b) {
  Manifold out;
  out.a = a;
  out.b = b;
  return out;
}

// a box on a slab, or under it: the face is that of the earlier body, or of the later one
Pair box_on_slab(bool slab_first) {
  Pair out;
  const auto add = [&](const char* name, Mesh mesh, const Pose& X) {
    return out.world.add_body(body_spec(name, std::move(mesh)), BodyKind::object, X);
  };
  const Pose above = Pose::translation({0.1, 0.05, 0.07 + 3e-5});
  Id<Body> slab, block;
  if (slab_first) slab = add("slab", box(1, 0.6, 0.1), {});
  block = add("block", box(0.06, 0.06, 0.04), above);
  if (!slab_first) slab = add("slab", box(1, 0.6, 0.1), {});
  out.manifold = slab_first ? manifold_of(slab, block) : manifold_of(block, slab);
  measure(out.world, out.manifold);
  return out;
}

// how far a point of one is from the nearest of the other
double apart(const ManifoldPoint& point, const Manifold& other, bool of_a) {
  double out = 1;
  for (const ManifoldPoint& p : other.points) out = std::min(out, of_a ? (p.p_a - point.p_a).norm() : (p.p_b - point.p_b).norm());
  return out;
}

}  // namespace

TEST_CASE("corners that slide over a face touch where measuring anew finds them") {
  for (const bool slab_first : {true, false}) {
    Pair pair = box_on_slab(slab_first);
    REQUIRE(pair.manifold.flat);
    CHECK(pair.manifold.flat->face_of_a == slab_first);
    const auto block = pair.world.find_body("block");
    Random random(7);
    for (int i = 0; i < 200; ++i) {
      const double turn = random.uniform(-0.3, 0.3), tilt = random.uniform(-1e-4, 1e-4);
      const Pose X{Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * Eigen::AngleAxisd(tilt, Vector3d::UnitX())),
                   {random.uniform(-0.1, 0.3), random.uniform(-0.1, 0.15), 0.07 + random.uniform(1e-5, 9e-5)}};
      pair.world.set_pose(block, X);
      Manifold followed = pair.manifold, fresh = manifold_of(pair.manifold.a, pair.manifold.b);
      const bool follows = follow_flat_contact(pair.world, followed);
      measure(pair.world, fresh);
      if (!follows) continue;
      REQUIRE(fresh.points.size() == followed.points.size());
      CHECK(fresh.clear == doctest::Approx(followed.clear).epsilon(1e-9));
      for (const bool of_a : {true, false})
        for (const ManifoldPoint& p : fresh.points) CHECK(apart(p, followed, of_a) < 1e-9);
      for (const ManifoldPoint& p : followed.points) CHECK((p.normal - fresh.points[0].normal).norm() < 1e-3);
    }
    // one that only slides does
    pair.world.set_pose(block, Pose::translation({0.25, 0, 0.07 + 2e-5}));
    CHECK(follow_flat_contact(pair.world, pair.manifold));
  }
}

TEST_CASE("a corner that leaves the face, another threshold, and bodies that become soft are measured anew") {
  Pair pair = box_on_slab(true);
  const auto block = pair.world.find_body("block");
  REQUIRE(pair.manifold.flat);
  SUBCASE("over the edge") { pair.world.set_pose(block, Pose::translation({0.49, 0.05, 0.07 + 3e-5})); }
  SUBCASE("lifted") { pair.world.set_pose(block, Pose::translation({0.1, 0.05, 0.07 + 2e-4})); }
  SUBCASE("in it") { pair.world.set_pose(block, Pose::translation({0.1, 0.05, 0.07 - 1e-5})); }
  SUBCASE("threshold") { pair.world.set_contact_threshold(2e-4); }
  SUBCASE("soft") { pair.world.set_elastic_modulus(block, 1e6); }
  CHECK_FALSE(follow_flat_contact(pair.world, pair.manifold));
}

TEST_CASE("only the corners of one flat face give a flat contact") {
  World world;
  const auto slab = world.add_body(body_spec("slab", box(1, 0.6, 0.1)), BodyKind::obstacle, {});
  const auto ball_id = world.add_body(body_spec("cup", moved(ball(0.03, 8, 8), {0, 0, 0})), BodyKind::object, Pose::translation({0, 0, 0.08003}));
  const auto over = world.add_body(body_spec("over", box(0.06, 0.06, 0.04)), BodyKind::object, Pose::translation({0.5, 0, 0.07003}));
  Manifold edge = manifold_of(slab, over), round = manifold_of(slab, ball_id);
  measure(world, edge);
  measure(world, round);
  CHECK(!edge.points.empty());
  CHECK_FALSE(edge.flat);
  CHECK(!round.points.empty());
}
