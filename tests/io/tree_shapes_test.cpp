#include "clench/io/tree/tree_shapes.h"

#include <numbers>

#include "clench/geometry/tree/shape.h"

using namespace clench;

using std::numbers::pi;
// ratio of the area of a circle of n edges to that of the disc
static const double disc = circle_edges / (2 * pi) * std::sin(2 * pi / circle_edges);

static void check_sound(const Mesh& mesh) {
  CHECK(find_faults(mesh).none());
  CHECK(solid_mass(mesh).volume > 0);
  // symmetric about the origin, up to rounding
  CHECK(solid_mass(mesh).centroid.norm() < 1e-12);
}

TEST_CASE("a box has its edges' volume") {
  const Mesh mesh = box_mesh({1, 2, 3});
  check_sound(mesh);
  CHECK(solid_mass(mesh).volume == doctest::Approx(6));
  CHECK(mesh.bounds().high == Eigen::Vector3d(0.5, 1, 1.5));
}

TEST_CASE("a cylinder has the volume of its prism, and its points on the true surface") {
  const Mesh mesh = cylinder_mesh(2, 5);
  check_sound(mesh);
  CHECK(solid_mass(mesh).volume == doctest::Approx(disc * pi * 4 * 5));
  CHECK(mesh.bounds().high.z() == 2.5);
  for (const auto& p : mesh.vertices) {
    const double r = p.head<2>().norm();
    CHECK((r < 1e-12 || std::abs(r - 2) < 1e-12));
  }
}

TEST_CASE("points of a capsule lie at its radius from its segment") {
  for (const double length : {0.0, 0.3, 4.0}) {
    const Mesh mesh = capsule_mesh(1.5, length);
    check_sound(mesh);
    CHECK(mesh.bounds().high.z() == doctest::Approx(length / 2 + 1.5));
    for (const auto& p : mesh.vertices) {
      const Eigen::Vector3d nearest(0, 0, std::clamp(p.z(), -length / 2, length / 2));
      CHECK((p - nearest).norm() == doctest::Approx(1.5));
    }
    // inscribed: smaller than the true solid, by less than 2 %
    const double volume = pi * 1.5 * 1.5 * (length + 4.0 / 3 * 1.5);
    CHECK(solid_mass(mesh).volume < volume);
    CHECK(solid_mass(mesh).volume > 0.98 * volume);
  }
}

TEST_CASE("the closed formulas are those that meshes come near from within") {
  const auto near = [](const MassProperties& exact, const Mesh& mesh) {
    const MassProperties from = solid_mass(mesh);
    // a circle of 32 edges has 0.64 % less area than the true one, a ball of 32 by 16 about 2 %
    // less volume
    CHECK(from.volume < exact.volume);
    CHECK(from.volume == doctest::Approx(exact.volume).epsilon(0.03));
    for (int i = 0; i < 3; ++i)
      CHECK(from.inertia(i, i) == doctest::Approx(exact.inertia(i, i)).epsilon(0.03));
  };
  near(cylinder_solid(0.1, 0.4), cylinder_mesh(0.1, 0.4));
  near(capsule_solid(0.1, 0.4), capsule_mesh(0.1, 0.4));
  near(capsule_solid(0.1, 0), capsule_mesh(0.1, 0));
  near(ellipsoid_solid({0.1, 0.2, 0.3}), ellipsoid_mesh({0.1, 0.2, 0.3}));
}

TEST_CASE("points of an ellipsoid fulfil its equation") {
  const Eigen::Vector3d radii(1, 2, 3);
  const Mesh mesh = ellipsoid_mesh(radii);
  check_sound(mesh);
  for (const auto& p : mesh.vertices) CHECK(p.cwiseQuotient(radii).norm() == doctest::Approx(1));
}
