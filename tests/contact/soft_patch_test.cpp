#include "clench/contact/soft_patch.h"

#include <algorithm>
#include <optional>

#include "clench/base/error.h"
#include "clench/math/decompositions.h"
#include "support/cases.h"
#include "support/curved.h"

using namespace clench;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double gap = 5e-5;  // within the contact threshold [m]
constexpr double rubber = 1.5e6;
using std::numbers::pi;

// the patch of the first site of a rubber body b on a rigid body a
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

// a body turned, then placed on the floor
SoftPatch drop(const Mesh& body, const Quaterniond& turn = Quaterniond::Identity(),
               const Mesh& floor = test::floor_board()) {
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

TEST_CASE("a ball on a plane has its own radius, for any mesh and orientation") {
  Random random(1);
  // edges of 11, 5.5, 2.8, 1.4, 0.7 mm and a neighborhood of 3.5 mm: each halving divides the error
  // by more than four
  const double tolerance[] = {0.2, 0.03, 0.004, 5e-4, 1e-4};
  for (int subdivisions = 1; subdivisions <= 5; ++subdivisions)
    for (int trial = 0; trial < test::cases(10); ++trial) {
      const SoftPatch patch = drop(test::icosphere(0.02, subdivisions), test::random_turn(random));
      check_radii(patch, 0.02, 0.02, tolerance[subdivisions - 1]);
      CHECK(!patch.at_edge);
      CHECK(!patch.flat[0]);
    }
  for (int trial = 0; trial < 10; ++trial)
    check_radii(drop(test::ball(0.02, 20, 40), test::random_turn(random)), 0.02, 0.02, 0.005);
}

TEST_CASE("the size of a ball does not matter, even below that of the neighborhood") {
  Random random(2);
  for (const double radius : {0.002, 0.003, 0.005, 0.01, 0.05})
    check_radii(drop(test::icosphere(radius, 4), test::random_turn(random)), radius, radius, 0.002);
}

TEST_CASE("a cylinder on a plane has its radius, and a flat direction along its axis") {
  for (const int segments : {16, 24, 64, 200})
    for (const double turn : {0.0, 0.05, 0.3}) {
      const Quaterniond about_x = Pose::turn(turn, Vector3d::UnitX()).rotation;
      const SoftPatch patch = drop(test::rod(0.015, 0.06, segments), about_x);
      // long triangles without a vertex near the center; 16 segments are 22 degrees each
      check_radii(patch, 0.015, 0.02, segments < 24 ? 0.02 : 0.003);
      CHECK(patch.flat == std::array{false, true});
      CHECK(std::abs(patch.directions.col(1).x()) == doctest::Approx(1).epsilon(1e-4));
    }
  // the value used for flat is no smaller than the curved one
  check_radii(drop(test::rod(0.03, 0.06, 64)), 0.03, 0.03, 0.003);
}

TEST_CASE("a torus on its side has the radii of its tube and its ring") {
  const Quaterniond upright = Pose::turn(pi / 2, Vector3d::UnitX()).rotation;
  check_radii(drop(test::torus(0.03, 0.01, 48, 24), upright), 0.01, 0.04, 0.01);
  check_radii(drop(test::torus(0.03, 0.01, 96, 48), upright), 0.01, 0.04, 0.005);
}

TEST_CASE(
    "a ball in a saddle has the sums of curvatures, with negative ones for hollow directions") {
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

TEST_CASE("a ball in a socket has the difference of curvatures, also when displaced") {
  const auto cup = [](double x, double y) { return socket(0.025, x, y) - gap; };
  for (const int cells : {40, 100})
    for (const double lean : {0.0, 0.15, 0.3}) {
      const Mesh hollow = test::graph(cup, 0.012, cells);
      const Vector3d down(std::sin(lean), 0, -std::cos(lean));
      const SoftPatch patch = press(hollow, test::icosphere(0.02, 4),
                                    Pose::translation(Vector3d(0, 0, 0.025) + 0.005 * down));
      // 1 / (50 - 40): errors of the curvatures are amplified by five
      check_radii(patch, 0.1, 0.1, 0.02);
      CHECK(patch.surfaces[0].curvatures.maxCoeff() < -39);
    }
}

TEST_CASE("two crossing cylinders touch as in Hertz's theory") {
  const double r1 = 0.01, r2 = 0.02;
  for (const double angle : {0.4, 0.7, pi / 2}) {
    const Pose X_AB{Pose::turn(angle, Vector3d::UnitZ()).rotation, {0, 0, r1 + r2 + gap}};
    const SoftPatch patch = press(test::rod(r1, 0.1, 200), test::rod(r2, 0.1, 200), X_AB);
    const double w = 1 / r1, y = 1 / r2;
    const double sum = 0.5 * (w + y);
    const double spread = 0.5 * std::sqrt(w * w + y * y + 2 * w * y * std::cos(2 * angle));
    const double second = 1 / (sum - spread);
    CHECK(std::abs(patch.relative_radii[0] * (sum + spread) - 1) < 0.002);
    // 1 / 1000 of the curvatures, in their difference
    CHECK(std::abs(1 / second - 1 / patch.relative_radii[1]) < 1e-3 * (w + y));
  }
}

TEST_CASE("faces are flat for any triangulation, and the far side of a thin plate does not count") {
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
  // flat on flat: the radius that represents flat surfaces
  const SoftPatch block = drop(test::box(0.1, 0.1, 0.1));
  check_radii(block, 0.02, 0.02, 1e-12);
  CHECK(block.flat == std::array{true, true});
  check_radii(press(test::floor_board(), test::box(0.1, 0.1, 0.1),
                    Pose::translation({0, 0, 0.05 + gap}), {.max_radius = 0.05}),
              0.05, 0.05, 1e-12);
}

TEST_CASE("a wide flat face stays flat next to a finely rounded edge") {
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

TEST_CASE("patches turn and move with the bodies, and do not depend on the order of the bodies") {
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
    // the sampling lattice has another orientation, which matters for facets only
    check_radii(again, patch.relative_radii[0], patch.relative_radii[1], 0.003);
    const SoftPatch swapped = press(upper, lower, X_AB.inverse());
    check_radii(swapped, patch.relative_radii[0], patch.relative_radii[1], 0.003);
    const Vector3d there = X_AB.rotation * swapped.directions.col(0);
    CHECK(std::abs(there.dot(patch.directions.col(0))) > 0.999);
  }
}

TEST_CASE("the order of contacts does not matter, bit-exactly") {
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

TEST_CASE("contacts share a patch if their neighborhoods overlap and their normals are similar") {
  int sites = 0;
  press(test::floor_board(), test::box(0.1, 0.1, 0.1), Pose::translation({0, 0, 0.05 + gap}), {},
        &sites);
  CHECK(sites == 4);
  const SoftPatch small = press(test::floor_board(), test::box(0.006, 0.006, 0.002),
                                Pose::translation({0, 0, 0.001 + gap}), {}, &sites);
  CHECK(sites == 1);
  CHECK(small.center_A.head<2>().norm() < 1e-9);
  // in a right-angled groove a small ball has two patches
  const double h = std::sqrt(2.0) * (0.003 + gap);
  const auto groove = [](double x, double) { return std::abs(x); };
  press(test::graph(groove, 0.02, 40), test::icosphere(0.003, 5), Pose::translation({0, 0, h}), {},
        &sites);
  CHECK(sites == 2);
}

namespace {

const Mesh cube = test::box(0.03, 0.03, 0.03);

SoftPatch drop_edge(const Mesh& body) {
  return drop(body, shortest_rotation(Vector3d(0, 1, 1), -Vector3d::UnitZ()));
}

// of two flat surfaces, rubber at 5 N
const double flat_indentation = std::sqrt(5 * 0.003 / (rubber * pi * 0.02));

// a ball against the edge of a board, its normal inclined to that of the upper face
SoftPatch roll(double angle, const Mesh& ball) {
  const Vector3d up(0, std::sin(angle), std::cos(angle));
  return press(test::floor_board(), ball,
               Pose::translation(Vector3d(0, 0.1, 0) + (0.02 + gap) * up));
}

}  // namespace

TEST_CASE("a corner touches as wide as it is deep, an edge over a strip as wide") {
  const SoftPatch face = drop(cube), edge = drop_edge(cube);
  const SoftPatch corner = drop(cube, shortest_rotation(Vector3d(1, 1, 1), -Vector3d::UnitZ()));
  CHECK(!face.at_edge);
  CHECK(edge.at_edge);
  CHECK(corner.at_edge);
  // at a depth d, the section of a cube's corner is a triangle of sides sqrt(6) d, whose ellipse
  // has the semi-axes d; the rays cut off its three tips
  const ContactEllipse at_corner = contact_ellipse(corner, 5), at_edge = contact_ellipse(edge, 5);
  for (const double a : at_corner.semi_axes)
    CHECK(a == doctest::Approx(flat_indentation).epsilon(0.12));
  // the strip |y| < d up to the end of the neighborhood has the semi-axes 2 d / sqrt(3) and 2
  // radius / sqrt(3), the rhombus in it sqrt(2/3) d and sqrt(2/3) radius; the rays give a value in
  // between
  const std::array<double, 2> size = {flat_indentation, edge.radius};
  for (int i = 0; i < 2; ++i) {
    CHECK(at_edge.semi_axes[i] > std::sqrt(2.0 / 3) * size[i]);
    CHECK(at_edge.semi_axes[i] < 2 / std::sqrt(3.0) * size[i]);
  }
  CHECK(torsion_radius(edge, 5) < 0.3 * torsion_radius(face, 5));
  CHECK(torsion_radius(corner, 5) < 0.11 * torsion_radius(face, 5));
  // a cone equally sharp on a half-space would touch more widely, by Sneddon (1965), and the
  // mattress under the corner even more: this is a lower bound
  const double steepness = std::sqrt(pi / (1.5 * std::sqrt(3.0)));  // of the cone with its sections
  const double half_space = std::sqrt(2 * 5 / (pi * rubber * steepness));
  const double mattress = std::cbrt(5 * 0.003 / rubber / (0.5 * std::sqrt(3.0))) / steepness;
  CHECK(at_corner.semi_axes[1] < half_space);
  CHECK(half_space < mattress);
  // on the rim of a plate of 2 mm, the patch is an ellipse hardly wider than the plate
  const SoftPatch rim = drop(test::box(0.1, 0.002, 0.03));
  const auto axes = contact_ellipse(rim, 5).semi_axes;
  CHECK(std::min(axes[0], axes[1]) < 0.0018);
  CHECK(torsion_radius(rim, 5) < 0.6 * torsion_radius(face, 5));
}

TEST_CASE(
    "sharp contacts stay sharp at any force and stiffness, and resist more when pressed harder") {
  const Mesh edge =
      test::moved(cube, Pose::turn(shortest_rotation(Vector3d(0, 1, 1), -Vector3d::UnitZ())));
  const Pose X = Pose::translation({0, 0, gap + 0.015 * std::sqrt(2.0)});
  const auto a = Shape::make(test::floor_board()), b = Shape::make(edge),
             ball = Shape::make(test::icosphere(0.02, 4));
  const Pose X_ball = Pose::translation({0, 0, gap - ball->bounds().low.z()});
  const auto touches = contact_set(*a, *b, X), touches_ball = contact_set(*a, *ball, X_ball);
  for (const double modulus : {1e5, rubber, 1e7, 1e9, 2e11}) {
    const Elasticity soft{.modulus = modulus};
    const SoftPatch sharp = soft_patch(*soft_sites(a, b, X, {}, soft, touches)[0]);
    const SoftPatch round = soft_patch(*soft_sites(a, ball, X_ball, {}, soft, touches_ball)[0]);
    CHECK(sharp.at_edge);
    double before = 0;
    for (const double force : {0.0, 0.01, 0.1, 1.0, 10.0, 100.0}) {
      const double now = torsion_radius(sharp, force);
      CHECK(now <= 0.55 * torsion_radius(round, force));
      CHECK(now >= before);
      before = now;
    }
  }
}

TEST_CASE(
    "torsion decreases gradually as a ball rolls from a face over an edge, and increases again") {
  const Mesh ball = test::icosphere(0.02, 4);
  const double face = torsion_radius(roll(0, ball), 5);
  double before = face;
  std::array<double, 91> radii;
  for (int degree = 0; degree <= 90; ++degree) {
    radii[degree] = torsion_radius(roll(degree * pi / 180, ball), 5);
    // steepest change: at 17 degrees the other face enters the sheet
    CHECK(radii[degree] > 0.75 * before);
    CHECK(0.75 * radii[degree] < before);
    before = radii[degree];
  }
  // facets of the ball: 5 %
  for (int degree = 1; degree <= 45; ++degree) CHECK(radii[degree] < 1.05 * radii[degree - 1]);
  for (int degree = 0; degree <= 45; ++degree)
    CHECK(radii[degree] == doctest::Approx(radii[90 - degree]).epsilon(0.05));
  CHECK(radii[45] < 0.3 * face);
  CHECK(radii[90] == doctest::Approx(face).epsilon(1e-3));
  // a ball that approaches the edge on the face loses nothing: its center still touches
  for (const double y : {0.08, 0.096, 0.098, 0.099, 0.1})
    CHECK(torsion_radius(press(test::floor_board(), ball, Pose::translation({0, y, 0.02 + gap})),
                         5) == doctest::Approx(face).epsilon(1e-3));
}

TEST_CASE("round bodies with coarse facets are not sharp, and edges with a small radius are") {
  Random random(8);
  for (const int subdivisions : {1, 2})
    for (int trial = 0; trial < 20; ++trial)
      CHECK(!drop(test::icosphere(0.02, subdivisions), test::random_turn(random)).at_edge);
  // facets of 22 to 36 degrees; the contact is on a facet, on an edge, and in between
  for (const int segments : {10, 12, 16})
    for (const double part : {0.0, 0.3, 0.5}) {
      const double angle = 2 * pi * part / segments;
      CHECK(!drop(test::rod(0.009, 0.06, segments), Pose::turn(angle, Vector3d::UnitX()).rotation)
                 .at_edge);
    }
  // an edge rounded by 0.3 mm is sharp, one rounded by 20 mm is not
  const auto prism = [](double round) {
    Mesh mesh;
    const int steps = 12;
    std::vector<Vector2d> outline = {{0.03, 0.06}, {-0.03, 0.06}};
    for (int i = 0; i <= steps; ++i) {
      const double a = pi / 2 * (i / static_cast<double>(steps) - 0.5),
                   reach = 0.03 / std::cos(pi / 4);
      // flanks of 45 degrees, tangent to a circle about (0, round)
      if (i == 0) outline.push_back({-reach, reach - (std::sqrt(2.0) - 1) * round});
      outline.push_back({round * std::sin(a), round - round * std::cos(a)});
      if (i == steps) outline.push_back({reach, reach - (std::sqrt(2.0) - 1) * round});
    }
    const int n = static_cast<int>(outline.size());
    for (const double y : {-0.03, 0.03})
      for (const auto& p : outline) mesh.vertices.push_back({p.x(), y, p.y()});
    for (int i = 0; i < n; ++i) {
      const int next = (i + 1) % n;
      mesh.triangles.push_back({i, n + i, n + next});
      mesh.triangles.push_back({i, n + next, next});
    }
    return mesh;
  };
  CHECK(drop(prism(0.0003)).at_edge);
  CHECK(!drop(prism(0.02)).at_edge);
  CHECK(torsion_radius(drop(prism(0.0003)), 5) < 0.5 * torsion_radius(drop(prism(0.02)), 5));
}

TEST_CASE("radii beyond 1 m blend into that of flat surfaces, without a jump") {
  double before = 0;
  const auto radius = [](double r) {
    const auto dome = [&](double x, double y) { return -0.5 * (x * x + y * y) / r - gap; };
    return press(test::graph(dome, 0.01, 4), test::box(0.2, 0.2, 0.02),
                 Pose::translation({0, 0, 0.01}));
  };
  for (double r = 0.8; r < 2.4; r *= 1.02) {
    const SoftPatch patch = radius(r);
    if (r < 0.98) check_radii(patch, r, r, 1e-3);
    if (r > 2.05) check_radii(patch, 0.02, 0.02, 1e-9);
    CHECK(patch.flat[0] == (r > 1));
    // 2 % of a curvature between 1 and 1/2 are 2 to 4 % of the blend, which spans a factor of 50
    if (before > 0)
      CHECK(std::abs(std::log(patch.relative_radii[0] / before)) < 0.04 * std::log(50) + 0.01);
    before = patch.relative_radii[0];
  }
}

TEST_CASE("the neighborhood shrinks with the modulus, between 3 and 10 mm") {
  CHECK(neighborhood_radius(1.5e6) == doctest::Approx(0.4 / std::cbrt(1.5e6)));
  CHECK(neighborhood_radius(1e5) == doctest::Approx(0.4 / std::cbrt(1e5)));
  CHECK(neighborhood_radius(1e9) == 0.005);
  CHECK(neighborhood_radius(1e4) == 0.005);
}

namespace {

SoftPatch paraboloid(double r1, double r2, const Elasticity& a, const Elasticity& b) {
  SoftPatch patch;
  patch.relative_radii = {r1, r2};
  patch.elastic_a = a, patch.elastic_b = b;
  return patch;
}

}  // namespace

TEST_CASE("a rubber ball of 20 mm on a rigid plane at 5 N agrees with the mattress formula") {
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

TEST_CASE("the ellipse and its torsion equal those of springs under a paraboloid") {
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
    // exact for a circle; the mean of the semi-axes is too small for long ellipses, by 9 % at 1:2
    const double radius = torsion_radius(patch, force);
    CHECK(radius <= torque / sum * 1.001);
    CHECK(radius >= torque / sum * (1 - 0.09 * (std::sqrt(ratio) - 1) - 1e-3));
  }
}

TEST_CASE(
    "two soft bodies yield as springs in series, while the original uses the stiffer body only") {
  const Elasticity a{.modulus = 1e6, .layer = 0.004, .poisson = 0.3};
  const Elasticity b{.modulus = 2e6, .layer = 0.003};
  const SoftPatch both = paraboloid(0.02, 0.02, a, b);
  const double compliance = 0.004 * (1 - 0.09) / 1e6 + 0.003 / 2e6;
  CHECK(contact_ellipse(both, 5).indentation ==
        doctest::Approx(std::sqrt(5 * compliance / (pi * 0.02))));
  const double stiffer = std::sqrt(5 * 0.003 / (2e6 * pi * 0.02));
  CHECK(contact_ellipse(both, 5, ModulusRule::larger).indentation == doctest::Approx(stiffer));
  // one soft body: both rules agree
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
    const SoftPatch ours = press(test::floor_board(), ball, X);
    const SoftPatch theirs = press(test::floor_board(), ball, X, {.fit = PatchFit::jet});
    check_radii(theirs, ours.relative_radii[0], ours.relative_radii[1], 0.005);
  }
}

TEST_CASE("a patch has finite numbers for any meshes") {
  Random random(6);
  int sites = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double size = 0.01 * std::exp(random.uniform(-1, 2));
    const auto any = [&]() {
      return Shape::make(trial % 2 ? test::potato(random, size, 6)
                                   : test::scaled(test::soup(random, 40, 0.1), size));
    };
    const auto a = any(), b = any();
    // move b towards a until they nearly touch
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

TEST_CASE("invalid numbers are rejected") {
  const auto a = Shape::make(test::floor_board()), b = Shape::make(test::icosphere(0.02, 2));
  const SoftSite site{.a = a,
                      .b = b,
                      .X_AB = {},
                      .elastic_a = {},
                      .elastic_b = {.modulus = rubber},
                      .radius = 0.0035,
                      .points_A = {Vector3d::Zero()},
                      .center_A = Vector3d::Zero(),
                      .normal_A = Vector3d::UnitZ()};
  CHECK_THROWS_WITH_AS(soft_patch(site, {.radius = -1}),
                       "contact patch: radius must be > 0 [m], got -1", Error);
  CHECK_THROWS_WITH_AS(soft_patch(site, {.max_radius = 0}),
                       "contact patch: max_radius must be > 0 [m], got 0", Error);
  CHECK_THROWS_WITH_AS(contact_ellipse(paraboloid(1, 1, {}, {.modulus = 1}), -2),
                       "contact patch: the normal force must be >= 0 [N], got -2", Error);
}

namespace {

Mesh mirrored(Mesh mesh) {
  for (Vector3d& p : mesh.vertices) p.x() = -p.x();
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  return mesh;
}

// with the other diagonal of each face of a box, and triangles and vertices in another order
Mesh cut_otherwise(Mesh mesh) {
  for (size_t t = 0; t + 1 < mesh.triangles.size(); t += 2) {
    const auto one = mesh.triangles[t], two = mesh.triangles[t + 1];
    // p q r and the corner that only the second triangle has
    for (int k = 0; k < 3; ++k) {
      const int p = one[k], q = one[(k + 1) % 3], r = one[(k + 2) % 3];
      if (std::find(two.begin(), two.end(), p) != two.end()) continue;
      for (const int s : two)
        if (s != q && s != r) mesh.triangles[t] = {p, q, s}, mesh.triangles[t + 1] = {p, s, r};
    }
  }
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  std::reverse(mesh.vertices.begin(), mesh.vertices.end());
  for (auto& t : mesh.triangles)
    for (int& i : t) i = last - i;
  return mesh;
}

// sizes and depths of all patches of two bodies, without their positions, at some forces
struct PatchNumbers {
  std::vector<double> sizes;   // area, torsion radius
  std::vector<double> depths;  // indentation, pressure
};

std::vector<PatchNumbers> numbers_of(const Mesh& a, const Mesh& b, const Pose& X_AB, bool a_soft) {
  const auto shape_a = Shape::make(a), shape_b = Shape::make(b);
  const Elasticity soft{.modulus = rubber}, rigid;
  const auto sites = soft_sites(shape_a, shape_b, X_AB, a_soft ? soft : rigid,
                                a_soft ? rigid : soft, contact_set(*shape_a, *shape_b, X_AB));
  std::vector<PatchNumbers> out;
  for (const auto& site : sites) {
    const SoftPatch patch = soft_patch(*site);
    PatchNumbers& numbers = out.emplace_back();
    for (const double force : {0.1, 1.0, 5.0, 25.0}) {
      const ContactEllipse e = contact_ellipse(patch, force);
      numbers.sizes.push_back(e.semi_axes[0] * e.semi_axes[1]);
      numbers.sizes.push_back(torsion_radius(patch, force));
      numbers.depths.push_back(e.indentation), numbers.depths.push_back(e.pressure);
    }
  }
  return out;
}

// all are equal within a tolerance: sums over circular sectors approximate integrals, and springs
// that just touch cause a kink
void check_alike(const std::vector<PatchNumbers>& some, const PatchNumbers& expected, double sizes,
                 double depths) {
  REQUIRE(!some.empty());
  for (const PatchNumbers& numbers : some)
    for (size_t i = 0; i < numbers.sizes.size(); ++i) {
      CHECK(numbers.sizes[i] == doctest::Approx(expected.sizes[i]).epsilon(sizes));
      CHECK(numbers.depths[i] == doctest::Approx(expected.depths[i]).epsilon(depths));
    }
}

}  // namespace

TEST_CASE(
    "equivalent corners have equal patches: turned, mirrored, swapped, moved, with another "
    "triangulation") {
  Random random(21);
  constexpr double rounding = 1e-7;
  const Mesh floor = test::floor_board();
  std::optional<PatchNumbers> corner;
  for (const double size : {0.012, 0.02, 0.03, 0.05, 0.1}) {
    const Mesh box = test::box(size, size, size);
    for (const double turn : {0.0, 0.3, pi / 4, 1.1}) {
      const Pose X_AB{Pose::turn(turn, Vector3d::UnitZ()).rotation, {0, 0, size / 2 + gap}};
      const auto corners = numbers_of(floor, box, X_AB, false);
      REQUIRE(corners.size() == 4);
      // the corners of all cubes wider than their patches have equal patches
      if (!corner) corner = corners[0];
      check_alike(corners, *corner, rounding, rounding);
      check_alike(numbers_of(floor, cut_otherwise(box), X_AB, false), *corner, rounding, rounding);
      check_alike(numbers_of(cut_otherwise(floor), box, X_AB, false), *corner, rounding, rounding);
      check_alike(numbers_of(box, floor, X_AB.inverse(), true), *corner, rounding, rounding);
      const Pose X = test::random_pose(random, 0.1), Y = test::random_pose(random, 0.1);
      check_alike(
          numbers_of(test::moved(floor, X), test::moved(box, Y), X * X_AB * Y.inverse(), false),
          *corner, rounding, rounding);
    }
  }
}

TEST_CASE("edges, rims, narrow pads and upright corners have equal patches in every position") {
  Random random(22);
  const auto check = [](const std::vector<PatchNumbers>& some, const PatchNumbers& expected) {
    check_alike(some, expected, 1e-5, 3e-3);
  };
  const Mesh floor = test::floor_board();
  std::vector<Mesh> bodies = {test::box(0.004, 0.006, 0.01), test::box(0.06, 0.002, 0.03)};
  for (const Vector3d& down : {Vector3d(1, 1, 1), Vector3d(0, 1, 1), Vector3d(0.2, 0.5, 1)})
    bodies.push_back(
        test::moved(cube, Pose::turn(shortest_rotation(down.normalized(), -Vector3d::UnitZ()))));
  for (const Mesh& body : bodies) {
    const double height = gap - Shape::make(body)->bounds().low.z();
    const Pose X_AB = Pose::translation({0, 0, height});
    const auto here = numbers_of(floor, body, X_AB, false);
    check(here, here[0]);
    check(numbers_of(body, floor, X_AB.inverse(), true), here[0]);
    check(numbers_of(floor, mirrored(body), X_AB, false), here[0]);
    for (int trial = 0; trial < 5; ++trial) {
      const Pose turn = Pose::turn(random.uniform(0, 6), Vector3d::UnitZ());
      check(numbers_of(floor, body, turn * X_AB, false), here[0]);
    }
  }
}
