#include "clench/model/penetration.h"

#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "support/robots.h"
#include "support/shapes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

Mesh without_lid(Mesh mesh) {
  mesh.triangles.resize(mesh.triangles.size() - 2);
  return mesh;
}

}  // namespace

TEST_CASE("the pair with the largest overlap is returned, with its point in world axes") {
  World world;
  const auto add = [&](const char* name, const Mesh& mesh, const Vector3d& at) {
    return world.add_body(body_spec(name, mesh), BodyKind::object, Pose::translation(at));
  };
  const auto slab = add("slab", box(2, 2, 0.2), {0, 0, 5});
  const auto low = add("low", box(0.1, 0.1, 0.1), {0.3, 0, 5.14});
  const auto lower = add("lower", box(0.1, 0.1, 0.1), {-0.3, 0, 5.11});
  const auto away = add("away", box(0.1, 0.1, 0.1), {0, 0, 8});
  const BodyPenetration found =
      penetration(world, std::array{away, low, lower}, std::array{slab, away});
  CHECK(found.a == lower);
  CHECK(found.b == slab);
  CHECK(found.depth == doctest::Approx(0.04).epsilon(2e-3));
  CHECK(found.p_W.z() == doctest::Approx(5.06).epsilon(1e-3));
  CHECK(std::abs(found.p_W.x() + 0.3) <= 0.05 + 1e-12);
  // a body does not overlap itself
  CHECK(penetration(world, std::array{away}, std::array{away}).depth == 0);
  CHECK_FALSE(penetration(world, std::array{away}, std::array{slab}).a);
}

TEST_CASE("the surface of an open mesh counts, and two crossing open meshes have no finite depth") {
  World world;
  const auto add = [&](const char* name, const Mesh& mesh, double z) {
    return world.add_body(body_spec(name, mesh), BodyKind::object, Pose::translation({0, 0, z}));
  };
  const auto tray = add("tray", without_lid(box(0.4, 0.4, 0.1)), 0);
  const auto bar = add("bar", box(0.02, 0.02, 0.3), 0);
  REQUIRE_FALSE(world.body(tray).shape->closed());
  for (const auto& [a, b] : {std::pair(tray, bar), std::pair(bar, tray)}) {
    const BodyPenetration found = penetration(world, std::array{a}, std::array{b});
    CHECK(found.depth == doctest::Approx(0.01).epsilon(2e-3));
    CHECK(found.a == a);
  }
  const auto other = add("other", without_lid(box(0.1, 0.1, 0.3)), 0);
  const double depth = penetration(world, std::array{other}, std::array{tray}).depth;
  CHECK(depth == std::numeric_limits<double>::infinity());
  world.set_pose(other, Pose::translation({0, 0, 1}));
  CHECK(penetration(world, std::array{other}, std::array{tray}).depth == 0);
}
