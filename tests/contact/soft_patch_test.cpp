#include "contact/soft_patch.h"

#include <algorithm>

#include "base/error.h"
#include "math/decompositions.h"
#include "support/curved.h"

using namespace clench;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double gap = 5e-5;  // within the contact threshold [m]
constexpr double rubber = 1.5e6;
const double pi = std::numbers::pi;

Mesh floor_mesh() {
  return test::moved(test::box(0.2, 0.2, 0.02), Pose::translation({0, 0, -0.01}));
}

// the patch of the first site of a rubber body b on a rigid a
SoftPatch press(const Mesh& a, const Mesh& b, const Pose& X_AB, const PatchOptions& options = {},
                int* site_count = nullptr) {
  const auto shape_a = Shape::make(a), shape_b = Shape::make(b);
  const auto touches = contact_set(*shape_a, *shape_b, X_AB);
  REQUIRE(!touches.empty());
  auto sites = soft_sites(shape_a, shape_b, X_AB, {}, {.modulus = rubber}, touches);
  const SoftPatch patch = soft_patch(*sites[0], options);
  if (site_count) {
    std::sort(sites.begin(), sites.end());
    *site_count = static_cast<int>(std::unique(sites.begin(), sites.end()) - sites.begin());
  }
  return patch;
}

// a body turned, then put on the floor
SoftPatch drop(const Mesh& body, const Quaterniond& turn = Quaterniond::Identity(),
               const Mesh& floor = floor_mesh()) {
  const Mesh turned = test::moved(body, Pose::turn(turn));
  return press(floor, turned,
               Pose::translation({0, 0, gap - Shape::make(turned)->bounds().low.z()}));
}

void check_radii(const SoftPatch& patch, double first, double second, double tolerance) {
  CHECK(std::abs(patch.relative_radii[0] / first - 1) <= tolerance);
  CHECK(std::abs(patch.relative_radii[1] / second - 1) <= tolerance);
}

double socket(double radius, double x, double y) {
  return radius - std::sqrt(radius * radius - x * x - y * y);
}

}  // namespace

TEST_CASE("a ball on a plane has its own radius, whatever its mesh and its turn") {
  Random random(1);
  // edges of 11, 5.5, 2.8, 1.4, 0.7 mm beside a neighbourhood of 3.5 mm: the error falls by more than
  // four with each halving
  const double tolerance[] = {0.2, 0.03, 0.004, 5e-4, 1e-4};
  for (int subdivisions = 1; subdivisions <= 5; ++subdivisions)
    for (int trial = 0; trial < 10; ++trial) {
      const SoftPatch patch = drop(test::icosphere(0.02, subdivisions), test::random_turn(random));
      check_radii(patch, 0.02, 0.02, tolerance[subdivisions - 1]);
      CHECK(!patch.sharp);
      CHECK(!patch.flat[0]);
    }
  for (int trial = 0; trial < 10; ++trial)
    check_radii(drop(test::ball(0.02, 20, 40), test::random_turn(random)), 0.02, 0.02, 0.005);
}

TEST_CASE("a ball's size does not matter, even where it is smaller than the neighbourhood") {
  Random random(2);
  for (const double radius : {0.002, 0.003, 0.005, 0.01, 0.05})
    check_radii(drop(test::icosphere(radius, 4), test::random_turn(random)), radius, radius, 0.002);
}

TEST_CASE("a cylinder on a plane has its radius, and a flat direction along its axis") {
  for (const int segments : {16, 24, 64, 200})
    for (const double turn : {0.0, 0.05, 0.3}) {
      const Quaterniond about_x = Pose::turn(turn, Vector3d::UnitX()).rotation;
      const SoftPatch patch = drop(test::rod(0.015, 0.06, segments), about_x);
      // long triangles without a vertex near the middle; 16 segments are 22 degrees each
      check_radii(patch, 0.015, 0.02, segments < 24 ? 0.02 : 0.003);
      CHECK(patch.flat == std::array{false, true});
      CHECK(std::abs(patch.directions.col(1).x()) == doctest::Approx(1).epsilon(1e-4));
    }
  // what stands for flat is no less than the curved one
  check_radii(drop(test::rod(0.03, 0.06, 64)), 0.03, 0.03, 0.003);
}

TEST_CASE("a torus on its side has the radii of its tube and its ring") {
  const Quaterniond upright = Pose::turn(pi / 2, Vector3d::UnitX()).rotation;
  check_radii(drop(test::torus(0.03, 0.01, 48, 24), upright), 0.01, 0.04, 0.01);
  check_radii(drop(test::torus(0.03, 0.01, 96, 48), upright), 0.01, 0.04, 0.005);
}

TEST_CASE("a ball in a saddle touches with the sums of curvatures, hollow ones negative") {
  const auto saddle = [](double x, double y) { return -0.5 * (30 * x * x - 20 * y * y) - gap; };
  for (const int cells : {12, 30, 80})
    for (const double jitter : {0.0, 0.3}) {
      // seen from below, so that the lower surface rises along y
      const SoftPatch patch = press(test::graph(saddle, 0.01, cells, jitter),
                                    test::icosphere(0.02, 4), Pose::translation({0, 0, 0.02}));
      check_radii(patch, 1.0 / 80, 1.0 / 30, cells < 30 ? 0.02 : 0.005);
      CHECK(std::abs(patch.directions.col(0).x()) > 0.999);
      CHECK(patch.surfaces[0].curvatures[1] < 0);
    }
}

TEST_CASE("a ball in a socket touches with the difference of curvatures, displaced too") {
  const auto cup = [](double x, double y) { return socket(0.025, x, y) - gap; };
  for (const int cells : {40, 100})
    for (const double lean : {0.0, 0.15, 0.3}) {
      const Mesh hollow = test::graph(cup, 0.012, cells);
      const Vector3d down(std::sin(lean), 0, -std::cos(lean));
      const SoftPatch patch = press(hollow, test::icosphere(0.02, 4),
                                    Pose::translation(Vector3d(0, 0, 0.025) + 0.005 * down));
      // 1 / (50 - 40): errors of the curvatures count five times
      check_radii(patch, 0.1, 0.1, 0.02);
      CHECK(patch.surfaces[0].curvatures.maxCoeff() < -39);
    }
}

TEST_CASE("two crossing cylinders touch as Hertz has it") {
  const double r1 = 0.01, r2 = 0.02;
  for (const double angle : {0.4, 0.7, pi / 2}) {
    const Pose X_AB{Pose::turn(angle, Vector3d::UnitZ()).rotation, {0, 0, r1 + r2 + gap}};
    const SoftPatch patch = press(test::rod(r1, 0.1, 200), test::rod(r2, 0.1, 200), X_AB);
    const double w = 1 / r1, y = 1 / r2;
    const double sum = 0.5 * (w + y);
    const double spread = 0.5 * std::sqrt(w * w + y * y + 2 * w * y * std::cos(2 * angle));
    const double second = 1 / (sum - spread);
    CHECK(std::abs(patch.relative_radii[0] * (sum + spread) - 1) < 0.002);
    // 1 of 1000 of the curvatures, in their difference
    CHECK(std::abs(1 / second - 1 / patch.relative_radii[1]) < 1e-3 * (w + y));
  }
}

TEST_CASE("faces are flat however they are cut, and a thin plate has no far side") {
  const auto flat = [](double, double) { return -gap; };
  Random random(3);
  for (const int cells : {1, 3, 10, 60}) {
    const SoftPatch patch = press(test::graph(flat, 0.05, cells, 0.2), test::icosphere(0.02, 4),
                                  Pose::translation({0.001, 0.002, 0.02}));
    CHECK(patch.surfaces[0].curvatures.norm() < 1e-6);
    check_radii(patch, 0.02, 0.02, 1e-3);
  }
  const Mesh plate = test::moved(test::box(0.1, 0.1, 0.0005), Pose::translation({0, 0, -0.00025}));
  const SoftPatch on_plate = drop(test::icosphere(0.02, 4), test::random_turn(random), plate);
  CHECK(on_plate.surfaces[0].residual < 1e-9);
  for (const Vector3d& p : on_plate.points[0]) CHECK(std::abs(p.z()) < 1e-9);
  // flat on flat: the radius that stands for none
  const SoftPatch block = drop(test::box(0.1, 0.1, 0.1));
  check_radii(block, 0.02, 0.02, 1e-12);
  CHECK(block.flat == std::array{true, true});
  check_radii(press(floor_mesh(), test::box(0.1, 0.1, 0.1), Pose::translation({0, 0, 0.05 + gap}),
                    {.flat_radius = 0.05}),
              0.05, 0.05, 1e-12);
}

TEST_CASE("a wide flat face stays flat beside a finely rounded edge") {
  // a prism: a flat bottom of 60 mm between quarter rounds of 3 mm in steps of 22 degrees
  Mesh mesh;
  std::vector<Vector2d> outline;
  for (int i = 0; i <= 4; ++i) {
    const double a = pi / 8 * i;
    outline.push_back({0.03 + 0.003 * std::sin(a), 0.003 - 0.003 * std::cos(a)});
  }
  for (int i = 4; i >= 0; --i) outline.push_back({-outline[i].x(), outline[i].y()});
  const int n = static_cast<int>(outline.size());
  for (const double y : {-0.03, 0.03})
    for (const auto& p : outline) mesh.vertices.push_back({p.x(), y, p.y()});
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.triangles.push_back({i, n + next, next});
    mesh.triangles.push_back({i, n + i, n + next});
    if (i > 1)
      mesh.triangles.push_back({0, i - 1, i}), mesh.triangles.push_back({n, n + i, n + i - 1});
  }
  REQUIRE(Shape::make(mesh)->closed());
  if (Shape::make(mesh)->solid().volume < 0) mesh = test::inverted(mesh);
  const SoftPatch patch =
      press(test::icosphere(0.02, 4), mesh, Pose::translation({0, 0, 0.02 + gap}));
  CHECK(patch.surfaces[1].curvatures.cwiseAbs().maxCoeff() < 0.01);
}

TEST_CASE("patches turn and move with the bodies, and do not care which of them comes first") {
  Random random(4);
  for (int trial = 0; trial < 10; ++trial) {
    const Mesh lower = test::rod(0.012, 0.05, 40), upper = test::torus(0.02, 0.008, 60, 30);
    const Pose X_AB{Pose::turn(0.4, Vector3d::UnitZ()).rotation *
                        Pose::turn(pi / 2, Vector3d::UnitX()).rotation,
                    {0, 0, 0.012 + 0.028 + gap}};
    const SoftPatch patch = press(lower, upper, X_AB);
    // other coordinates of both meshes: the same patch
    const Pose X = test::random_pose(random, 1), Y = test::random_pose(random, 1);
    const SoftPatch again =
        press(test::moved(lower, X), test::moved(upper, Y), X * X_AB * Y.inverse());
    // the lattice lies another way, which tells on the facets alone
    check_radii(again, patch.relative_radii[0], patch.relative_radii[1], 0.003);
    const SoftPatch swapped = press(upper, lower, X_AB.inverse());
    check_radii(swapped, patch.relative_radii[0], patch.relative_radii[1], 0.003);
    const Vector3d there = X_AB.rotation * swapped.directions.col(0);
    CHECK(std::abs(there.dot(patch.directions.col(0))) > 0.999);
  }
}

TEST_CASE("the order of contacts does not matter, to the bit") {
  const auto a = Shape::make(test::moved(
      test::graph([](double x, double y) { return socket(0.025, x, y) - gap; }, 0.012, 30),
      Pose()));
  const auto b = Shape::make(test::icosphere(0.02, 4));
  const Pose X_AB = Pose::translation({0, 0, 0.02});
  auto touches = contact_set(*a, *b, X_AB);
  REQUIRE(touches.size() > 5);
  const auto first = soft_sites(a, b, X_AB, {}, {.modulus = rubber}, touches);
  std::reverse(touches.begin(), touches.end());
  std::swap(touches[1], touches[3]);
  const auto second = soft_sites(a, b, X_AB, {}, {.modulus = rubber}, touches);
  REQUIRE(first[0]->points_A.size() == second[0]->points_A.size());
  const SoftPatch one = soft_patch(*first[0]), two = soft_patch(*second[0]);
  CHECK(one.relative_radii == two.relative_radii);
  CHECK(one.directions == two.directions);
  CHECK(torsion_radius(one, 5) == torsion_radius(two, 5));
}

TEST_CASE("contacts share a patch where their neighbourhoods overlap and look the same way") {
  int sites = 0;
  press(floor_mesh(), test::box(0.1, 0.1, 0.1), Pose::translation({0, 0, 0.05 + gap}), {}, &sites);
  CHECK(sites == 4);
  const SoftPatch small = press(floor_mesh(), test::box(0.006, 0.006, 0.002),
                                Pose::translation({0, 0, 0.001 + gap}), {}, &sites);
  CHECK(sites == 1);
  CHECK(small.centre_A.head<2>().norm() < 1e-9);
  CHECK(small.extent[0] == doctest::Approx(0.003).epsilon(0.25));  // up to a step of the lattice
  // in a right-angled groove a small ball has two
  const double h = std::sqrt(2.0) * (0.003 + gap);
  const auto groove = [](double x, double) { return std::abs(x); };
  press(test::graph(groove, 0.02, 40), test::icosphere(0.003, 5), Pose::translation({0, 0, h}), {},
        &sites);
  CHECK(sites == 2);
}

TEST_CASE("corners and edges are told, and resist less of a turn than a face") {
  const Mesh cube = test::box(0.03, 0.03, 0.03);
  const SoftPatch face = drop(cube);
  const SoftPatch edge = drop(cube, least_turn(Vector3d(0, 1, 1), -Vector3d::UnitZ()));
  const SoftPatch corner = drop(cube, least_turn(Vector3d(1, 1, 1), -Vector3d::UnitZ()));
  CHECK(!face.sharp);
  CHECK(edge.sharp);
  CHECK(corner.sharp);
  CHECK(torsion_radius(edge, 5) < 0.8 * torsion_radius(face, 5));
  CHECK(torsion_radius(corner, 5) < 0.65 * torsion_radius(face, 5));
  // the rim of a plate of 2 mm is an ellipse no wider than it
  const SoftPatch rim = drop(test::box(0.1, 0.002, 0.03));
  CHECK(rim.extent[1] + rim.extent[0] < 0.01);
  CHECK(torsion_radius(rim, 5) < 0.65 * torsion_radius(face, 5));
}

TEST_CASE("the neighbourhood shrinks with the modulus, between 3 and 10 mm") {
  CHECK(neighbourhood_radius(1.5e6) == doctest::Approx(0.4 / std::cbrt(1.5e6)));
  CHECK(neighbourhood_radius(1e5) == doctest::Approx(0.4 / std::cbrt(1e5)));
  CHECK(neighbourhood_radius(1e9) == 0.005);
  CHECK(neighbourhood_radius(1e4) == 0.005);
}

namespace {

SoftPatch paraboloid(double r1, double r2, const Elasticity& a, const Elasticity& b) {
  SoftPatch patch;
  patch.relative_radii = {r1, r2};
  patch.extent = {1, 1};
  patch.elastic_a = a, patch.elastic_b = b;
  return patch;
}

}  // namespace

TEST_CASE("a rubber ball of 20 mm on a rigid plane at 5 N is the mattress formula") {
  const SoftPatch patch = drop(test::icosphere(0.02, 5));
  const double delta = std::sqrt(5 * 0.003 / (rubber * pi * 0.02));
  const ContactEllipse e = contact_ellipse(patch, 5);
  CHECK(e.indentation == doctest::Approx(delta).epsilon(1e-4));
  CHECK(e.semi_axes[0] == doctest::Approx(std::sqrt(2 * delta * 0.02)).epsilon(1e-4));
  CHECK(e.pressure == doctest::Approx(rubber * delta / 0.003).epsilon(1e-4));
  CHECK(torsion_radius(patch, 5) ==
        doctest::Approx(8 * std::sqrt(2 * delta * 0.02) / 15).epsilon(1e-4));
  CHECK(torsion_radius(patch, 0) == 0);
}

TEST_CASE("the ellipse and its torsion are what springs under a paraboloid do") {
  for (const double ratio : {1.0, 2.0, 4.0}) {
    const double r1 = 0.02, r2 = ratio * r1, force = 5, stiffness = rubber / 0.003;
    const SoftPatch patch = paraboloid(r1, r2, {}, {.modulus = rubber});
    const ContactEllipse e = contact_ellipse(patch, force);
    const double step = 1e-5;
    double sum = 0, torque = 0;
    for (double x = -0.015; x <= 0.015; x += step)
      for (double y = -0.015; y <= 0.015; y += step) {
        const double depth = e.indentation - x * x / (2 * r1) - y * y / (2 * r2);
        if (depth <= 0) continue;
        sum += stiffness * depth * step * step;
        torque += stiffness * depth * std::hypot(x, y) * step * step;
      }
    CHECK(sum == doctest::Approx(force).epsilon(1e-3));
    // exact for a circle; the mean of the semi-axes falls short for long ellipses, by 9 % at 1:2
    const double radius = torsion_radius(patch, force);
    CHECK(radius <= torque / sum * 1.001);
    CHECK(radius >= torque / sum * (1 - 0.09 * (std::sqrt(ratio) - 1) - 1e-3));
  }
}

TEST_CASE(
    "two soft bodies give way one after the other, where the original took the stiffer alone") {
  const Elasticity a{.modulus = 1e6, .layer = 0.004, .poisson = 0.3};
  const Elasticity b{.modulus = 2e6, .layer = 0.003};
  const SoftPatch both = paraboloid(0.02, 0.02, a, b);
  const double compliance = 0.004 * (1 - 0.09) / 1e6 + 0.003 / 2e6;
  CHECK(contact_ellipse(both, 5).indentation ==
        doctest::Approx(std::sqrt(5 * compliance / (pi * 0.02))));
  const double stiffer = std::sqrt(5 * 0.003 / (2e6 * pi * 0.02));
  CHECK(contact_ellipse(both, 5, ModulusRule::larger).indentation == doctest::Approx(stiffer));
  // one alone: both rules agree
  const SoftPatch one = paraboloid(0.02, 0.02, {}, b);
  CHECK(contact_ellipse(one, 5).indentation == doctest::Approx(stiffer));
  CHECK(contact_ellipse(one, 5, ModulusRule::larger).indentation == doctest::Approx(stiffer));
}

TEST_CASE("the two fits agree on real patches") {
  if (!has_fit_jet()) return;
  Random random(5);
  for (const double radius : {0.01, 0.02, 0.05}) {
    const Mesh ball =
        test::moved(test::icosphere(radius, 4), Pose::turn(test::random_turn(random)));
    const Pose X = Pose::translation({0, 0, gap - Shape::make(ball)->bounds().low.z()});
    const SoftPatch ours = press(floor_mesh(), ball, X);
    const SoftPatch theirs = press(floor_mesh(), ball, X, {.fit = PatchFit::jet});
    check_radii(theirs, ours.relative_radii[0], ours.relative_radii[1], 0.005);
  }
}

TEST_CASE("whatever the meshes are, a patch is numbers") {
  Random random(6);
  int sites = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double size = 0.01 * std::exp(random.uniform(-1, 2));
    const auto any = [&]() {
      return Shape::make(trial % 2 ? test::potato(random, size, 6)
                                   : test::scaled(test::soup(random, 40, 0.1), size));
    };
    const auto a = any(), b = any();
    // b comes down on a until they nearly touch
    Pose X_AB = test::random_pose(random, 0);
    X_AB.position = 4 * size * test::random_direction(random);
    const Distance apart = distance(*a, *b, X_AB);
    if (apart.distance == 0) continue;
    X_AB.position += (apart.p_a - apart.p_b) * (1 - gap / apart.distance);
    const auto touches = contact_set(*a, *b, X_AB);
    const Elasticity soft{.modulus = std::exp(random.uniform(9, 25))};
    const auto all = soft_sites(a, b, X_AB, soft, {}, touches);
    REQUIRE(all.size() == touches.size());
    for (const SoftSitePtr& site : all) {
      const SoftPatch patch = soft_patch(*site);
      const ContactEllipse e = contact_ellipse(patch, 5);
      const double radius = torsion_radius(patch, 5);
      CHECK(std::isfinite(e.indentation));
      CHECK(patch.relative_radii[0] > 0);
      CHECK(patch.relative_radii[0] <= patch.relative_radii[1]);
      CHECK(patch.directions.allFinite());
      CHECK(std::isfinite(patch.residual));
      CHECK(radius >= 0);
      CHECK(std::isfinite(radius));
      ++sites;
    }
  }
  CHECK(sites > 100);
}

TEST_CASE("numbers that are none are refused") {
  const auto a = Shape::make(floor_mesh()), b = Shape::make(test::icosphere(0.02, 2));
  const SoftSite site{.a = a,
                      .b = b,
                      .X_AB = {},
                      .elastic_a = {},
                      .elastic_b = {.modulus = rubber},
                      .radius = 0.0035,
                      .points_A = {Vector3d::Zero()},
                      .centre_A = Vector3d::Zero(),
                      .normal_A = Vector3d::UnitZ()};
  CHECK_THROWS_WITH_AS(soft_patch(site, {.radius = -1}),
                       "contact patch: radius must be > 0 [m], got -1", Error);
  CHECK_THROWS_WITH_AS(soft_patch(site, {.flat_radius = 0}),
                       "contact patch: flat_radius must be > 0 [m], got 0", Error);
  CHECK_THROWS_WITH_AS(contact_ellipse(paraboloid(1, 1, {}, {.modulus = 1}), -2),
                       "contact patch: the normal force must be >= 0 [N], got -2", Error);
}
