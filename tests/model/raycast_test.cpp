#include "clench/model/raycast.h"

#include "clench/base/random.h"
#include "clench/geometry/query/queries.h"
#include "support/meshes.h"
#include "support/robots.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

TEST_CASE("a ray hits the nearest triangle of all, as in a search in world coordinates") {
  Random random(8, 0);
  World world;
  for (int i = 0; i < 12; ++i)
    world.add_body(body_spec("b", i % 2 ? box(0.2, 0.3, 0.4) : ball(0.15, 2)), BodyKind::object,
                   {random_turn(random), random_point(random, 0.25)});
  int hits = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vector3d origin = random_point(random, 1);
    const Vector3d direction = (random_point(random, 0.25) - origin).normalized();
    const double reach = random.uniform(0.2, 2);
    double nearest = reach;
    std::optional<Id<Body>> first;
    for (const auto id : world.bodies()) {
      Mesh mesh = world.body(id).shape->mesh();
      for (Vector3d& p : mesh.vertices) p = world.pose(id) * p;
      if (const auto hit = cast_ray(*Shape::make(mesh, "b"), origin, direction, nearest))
        nearest = hit->distance, first = id;
    }
    const auto found = raycast(world, origin, direction, reach);
    REQUIRE(found.has_value() == first.has_value());
    if (!found) continue;
    ++hits;
    CHECK(found->body == *first);
    // coordinates of 1 m, rounded by the transformation to the body's frame and back
    CHECK(std::abs(found->distance - nearest) < 1e-13);
    CHECK((found->p_W - origin - nearest * direction).norm() < 1e-13);
    CHECK(std::abs(found->n_W.norm() - 1) < 1e-15);
  }
  CHECK(hits > 60);
}

TEST_CASE(
    "a ray in another direction, one that ends before, and one through a body without a surface "
    "hit nothing") {
  World world;
  world.add_body(body_spec("b", box(0.1, 0.1, 0.1)), BodyKind::object, {});
  BodySpec frame = body_spec("f", box(1, 1, 1));
  frame.shape = nullptr;
  world.add_body(frame, BodyKind::object, {});
  CHECK(raycast(world, {1, 0, 0}, {-1, 0, 0}, 2)->distance == doctest::Approx(0.95));
  CHECK((raycast(world, {1, 0, 0}, {-1, 0, 0}, 2)->n_W - Vector3d::UnitX()).norm() < 1e-15);
  CHECK_FALSE(raycast(world, {1, 0, 0}, {-1, 0, 0}, 0.9));
  CHECK_FALSE(raycast(world, {1, 0, 0}, {1, 0, 0}, 2));
}
