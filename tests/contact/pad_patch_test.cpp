// Soft patches of pads are no wider than the pads.
#include <fmt/format.h>

#include <algorithm>

#include "clench/base/error.h"
#include "clench/contact/soft_patch.h"
#include "clench/math/decompositions.h"
#include "support/cases.h"
#include "support/curved.h"

using namespace clench;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double pad_gap = 5e-5;  // within the contact threshold [m]
constexpr double pad_modulus = 1.5e6;
constexpr double springs = 0.003 / pad_modulus;  // compliance [m/Pa]
using std::numbers::pi;

/// A pad with the given outline, counter-clockwise about the origin as seen from above: a flat sole
/// of rings of triangles at z = 0, with walls and a lid above.
Mesh pad_of(const std::vector<Vector2d>& outline, double height, int rings) {
  Mesh mesh;
  const int n = static_cast<int>(outline.size());
  mesh.vertices.push_back(Vector3d::Zero());
  for (int r = 1; r <= rings; ++r)
    for (const Vector2d& p : outline)
      mesh.vertices.push_back({p.x() * r / rings, p.y() * r / rings, 0});
  const int lid = static_cast<int>(mesh.vertices.size());
  for (const Vector2d& p : outline) mesh.vertices.push_back({p.x(), p.y(), height});
  mesh.vertices.push_back({0, 0, height});
  const auto at = [&](int r, int i) { return 1 + (r - 1) * n + i % n; };
  for (int i = 0; i < n; ++i) {
    mesh.triangles.push_back({0, at(1, i + 1), at(1, i)});
    for (int r = 1; r < rings; ++r) {
      mesh.triangles.push_back({at(r, i), at(r + 1, i + 1), at(r + 1, i)});
      mesh.triangles.push_back({at(r, i), at(r, i + 1), at(r + 1, i + 1)});
    }
    const int a = at(rings, i), b = at(rings, i + 1), c = lid + i, d = lid + (i + 1) % n;
    mesh.triangles.push_back({a, b, d});
    mesh.triangles.push_back({a, d, c});
    mesh.triangles.push_back({c, d, lid + n});
  }
  REQUIRE(Shape::make(mesh)->closed());
  REQUIRE(Shape::make(mesh)->solid().volume > 0);
  return mesh;
}

std::vector<Vector2d> rectangle(double half_x, double half_y, int a_side = 1) {
  const std::vector<Vector2d> corners = {
      {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}};
  std::vector<Vector2d> out;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < a_side; ++i)
      out.push_back(corners[k] + (corners[(k + 1) % 4] - corners[k]) * i / a_side);
  return out;
}

std::vector<Vector2d> circle(double radius, int segments) {
  std::vector<Vector2d> out;
  for (int i = 0; i < segments; ++i) {
    const double a = 2 * pi * i / segments;
    out.push_back({radius * std::cos(a), radius * std::sin(a)});
  }
  return out;
}

/// The patch of a contact at a point of the pad, in the frame of the floor; the pad is soft, and
/// turned about z.
SoftPatch patch_at(const Mesh& floor, const Mesh& pad, double turn, const Vector2d& place) {
  const Pose X_AB{Pose::turn(turn, Vector3d::UnitZ()).rotation, {0, 0, pad_gap}};
  const Vector3d p = X_AB.rotation * Vector3d(place.x(), place.y(), 0);
  const Touch touch{.p_a = p, .p_b = p + Vector3d(0, 0, pad_gap), .normal_b = Vector3d::UnitZ()};
  const Elasticity soft{.modulus = pad_modulus};
  return soft_patch(*soft_sites(Shape::make(floor), Shape::make(pad), X_AB, {}, soft, {touch})[0]);
}

/// all patches, in the order in which the contacts are found
std::vector<SoftPatch> patches_of(const Mesh& floor, const Mesh& pad, double turn) {
  const auto a = Shape::make(floor), b = Shape::make(pad);
  const Pose X_AB{Pose::turn(turn, Vector3d::UnitZ()).rotation, {0, 0, pad_gap}};
  const auto sites =
      soft_sites(a, b, X_AB, {}, {.modulus = pad_modulus}, contact_set(*a, *b, X_AB));
  std::vector<SoftPatch> out;
  std::vector<const SoftSite*> known;
  for (const auto& site : sites)
    if (std::find(known.begin(), known.end(), site.get()) == known.end())
      known.push_back(site.get()), out.push_back(soft_patch(*site));
  return out;
}

/// semi-axis of two flat surfaces, or of a cylinder of a given radius on a flat, along its axis
double blunt_axis(double force, double radius = 0.02) {
  return std::sqrt(2 * std::sqrt(force * springs / (pi * radius)) * radius);
}

/// semi-axes, the shorter one first
Vector2d axes_of(const SoftPatch& patch, double force) {
  const auto [a, b] = contact_ellipse(patch, force).semi_axes;
  return {std::min(a, b), std::max(a, b)};
}

/// extent of an ellipse along a direction of the frame of the floor
double reach_of(const SoftPatch& patch, double force, const Vector3d& direction) {
  const auto axes = contact_ellipse(patch, force).semi_axes;
  return std::hypot(axes[0] * patch.directions.col(0).dot(direction),
                    axes[1] * patch.directions.col(1).dot(direction));
}

}  // namespace

TEST_CASE("a square pad on a plane has a circle no wider than itself, for any orientation") {
  for (const double half : {0.002, 0.003, 0.0037, 0.005, 0.008, 0.015})
    for (const double turn : {0.0, 0.13, 0.4, pi / 4})
      for (const int rings : {1, 6})
        for (const double force : {0.1, 5.0, 60.0}) {
          const Mesh pad = pad_of(rectangle(half, half, rings), 0.004, rings);
          const Vector2d axes = axes_of(patch_at(test::floor_board(), pad, turn, {0, 0}), force);
          const double expected = std::min(half, blunt_axis(force));
          CHECK(axes[1] <= 1.0001 * expected);
          // a pad much smaller than the patch is bounded by its moments, which are larger
          CHECK(axes[0] >= 0.985 * expected);
        }
}

TEST_CASE("the patch of a pad of 6 mm stays within 3 mm, for any contact point") {
  Random random(1);
  const Mesh pad = pad_of(rectangle(0.003, 0.003), 0.004, 1);
  for (const SoftPatch& patch : patches_of(test::floor_board(), pad, 0.3)) {
    CHECK(axes_of(patch, 5)[1] < 0.0030003);
    CHECK(axes_of(patch, 5)[0] > 0.0029);
  }
  for (int trial = 0; trial < test::cases(40); ++trial) {
    const Vector2d place(random.uniform(-0.003, 0.003), random.uniform(-0.003, 0.003));
    const double turn = random.uniform(0, 6);
    const SoftPatch patch = patch_at(test::floor_board(), pad, turn, place);
    const Vector3d x(std::cos(turn), std::sin(turn), 0), y(-x.y(), x.x(), 0);
    CHECK(reach_of(patch, 5, x) <= 1.0001 * 0.003);
    CHECK(reach_of(patch, 5, y) <= 1.0001 * 0.003);
    // at a corner, the patch is as narrow as the nearby region; rays bound it at the other sides
    CHECK(axes_of(patch, 5)[0] > 0.0022);
  }
}

TEST_CASE(
    "a rectangle bounds each semi-axis separately, and the torsion radius is below that of its "
    "full area") {
  for (const double half_x : {0.0015, 0.002, 0.003})
    for (const double half_y : {0.003, 0.006, 0.02})
      for (const double turn : {0.0, 0.2, 0.9})
        for (const int rings : {1, 5})
          for (const double force : {0.1, 5.0, 20.0}) {
            const Mesh pad = pad_of(rectangle(half_x, half_y, rings), 0.004, rings);
            const SoftPatch patch = patch_at(test::floor_board(), pad, turn, {0, 0});
            const Vector3d x(std::cos(turn), std::sin(turn), 0), y(-x.y(), x.x(), 0);
            const double blunt = blunt_axis(force);
            CHECK(reach_of(patch, force, x) <= 1.0001 * std::min(half_x, blunt));
            CHECK(reach_of(patch, force, y) <= 1.0001 * std::min(half_y, blunt));
            CHECK(reach_of(patch, force, x) >= 0.98 * std::min(half_x, blunt));
            // on a narrow pad, the area beyond the neighborhood of 3.5 mm is not certain to touch
            CHECK(reach_of(patch, force, y) >= 0.75 * std::min({half_y, blunt, patch.radius}));
            // even pressure over the pad: mean distance from its center, by summation
            double sum = 0;
            constexpr int steps = 40;
            for (int i = 0; i < steps; ++i)
              for (int j = 0; j < steps; ++j)
                sum += std::hypot(half_x * (i + 0.5) / steps, half_y * (j + 0.5) / steps);
            CHECK(torsion_radius(patch, force) < sum / (steps * steps));
          }
}

TEST_CASE("a disc bounds its circle by its radius, at the center and at its rim") {
  for (const double radius : {0.0025, 0.003, 0.004, 0.006, 0.01})
    for (const int segments : {24, 90})
      for (const double off : {0.0, 0.5, 0.95})
        for (const double force : {0.5, 5.0, 30.0}) {
          const Mesh pad = pad_of(circle(radius, segments), 0.004, 3);
          const SoftPatch patch = patch_at(test::floor_board(), pad, 0.1, {off * radius, 0});
          const double expected = std::min(radius, blunt_axis(force));
          CHECK(axes_of(patch, force)[1] <= 1.0001 * expected);
          CHECK(torsion_radius(patch, force) < 2 * radius / 3);
          // off center, rays miss the widest part, and near the rim half of the neighborhood is
          // missing
          if (off == 0) CHECK(axes_of(patch, force)[0] >= 0.98 * expected);
        }
}

TEST_CASE("a patch is in no direction wider than its pad, for any outline and contact point") {
  Random random(7);
  double widest = 0, narrowest = 2;
  for (int trial = 0; trial < test::cases(300); ++trial) {
    // corners on an ellipse at uneven angles: convex, and around the origin
    const int corners = 5 + trial % 6;
    const double size = random.uniform(0.0015, 0.008), ratio = random.uniform(0.4, 1);
    std::vector<Vector2d> outline;
    for (int i = 0; i < corners; ++i) {
      const double a = 2 * pi * (i + random.uniform(-0.35, 0.35)) / corners;
      outline.push_back({size * std::cos(a), ratio * size * std::sin(a)});
    }
    const double part = random.uniform(0, 0.9);
    const Vector2d place = part * outline[trial % corners];
    const double turn = random.uniform(0, 6), force = std::exp(random.uniform(-2, 4));
    const SoftPatch patch =
        patch_at(test::floor_board(), pad_of(outline, 0.004, 1 + trial % 3), turn, place);
    const Eigen::Rotation2Dd turned(turn);
    for (int i = 0; i < 90; ++i) {
      const Vector2d d(std::cos(pi * i / 90), std::sin(pi * i / 90));
      double low = 0, high = 0;
      for (const Vector2d& p : outline) {
        const double at = (turned * p).dot(d);
        low = std::min(low, at), high = std::max(high, at);
      }
      const double reach = reach_of(patch, force, {d.x(), d.y(), 0});
      widest = std::max(widest, reach / ((high - low) / 2));
    }
    // and not much smaller than possible
    const Vector2d axes = axes_of(patch, force);
    narrowest = std::min(narrowest, std::sqrt(axes[0] * axes[1]) /
                                        std::min(blunt_axis(force), std::sqrt(ratio) * size));
  }
  CHECK(widest < 1.01);
  CHECK(narrowest > 0.5);
}

TEST_CASE("a pad on a large cylinder is bounded by its rim along the axis and across it") {
  for (const double radius : {0.05, 0.1, 0.3})
    for (const double half : {0.002, 0.003, 0.006})
      for (const double turn : {0.0, 0.5}) {
        const Mesh floor =
            test::moved(test::rod(radius, 0.2, 720), Pose::translation({0, 0, -radius}));
        const SoftPatch patch =
            patch_at(floor, pad_of(rectangle(half, half, 4), 0.004, 4), turn, {0, 0});
        // along the flat axis, the radius of the cylinder is used
        const double blunt = blunt_axis(5, radius);
        const Vector3d x(std::cos(turn), std::sin(turn), 0), y(-x.y(), x.x(), 0);
        for (const Vector3d& d : {x, y}) {
          CHECK(reach_of(patch, 5, d) <= 1.0001 * std::min(half, blunt));
          CHECK(reach_of(patch, 5, d) >= 0.97 * std::min(half, blunt));
        }
      }
}

TEST_CASE("no ellipse is wider than a small ball, and a nearby rim does not reduce a wider patch") {
  const Mesh small = test::moved(test::icosphere(0.002, 4), Pose::translation({0, 0, 0.002}));
  CHECK(blunt_axis(5, 0.002) > 0.0022);
  // up to a slope of 73 degrees, where the sheet of the ball ends
  const double axis = axes_of(patch_at(test::floor_board(), small, 0, {0, 0}), 5)[1];
  CHECK(axis < 0.002);
  CHECK(axis > 0.0018);
  // on a plate whose rim is outside the patch, or cuts off a half of it: the full size
  const Mesh ball = test::moved(test::icosphere(0.02, 4), Pose::translation({0, 0, 0.02}));
  for (const double half : {0.0045, 0.006, 0.1})
    for (const double force : {0.1, 5.0}) {
      const Mesh plate =
          test::moved(test::box(0.2, 2 * half, 0.02), Pose::translation({0, half, -0.01}));
      const double expected = std::min(half, blunt_axis(force));
      CHECK(axes_of(patch_at(plate, ball, 0, {0, 0}), force)[0] ==
            doctest::Approx(expected).epsilon(0.015));
    }
}

TEST_CASE("the part cut off at a rim deepens the center, so that the pressure balances the force") {
  for (const double half : {0.0028, 0.003, 0.0035, 0.0039, 0.005})
    for (const double force : {1.0, 5.0, 12.0}) {
      const SoftPatch patch =
          patch_at(test::floor_board(), pad_of(rectangle(half, half), 0.004, 1), 0, {0, 0});
      const ContactEllipse e = contact_ellipse(patch, force);
      const double paraboloid = 0.5 * pi * e.semi_axes[0] * e.semi_axes[1] * e.pressure;
      // pads wider than 80 % of their ellipse; narrower pads blend into even pressure
      if (1.15 * half > 0.82 * blunt_axis(force)) CHECK(paraboloid == doctest::Approx(force));
      CHECK(e.pressure == doctest::Approx(e.indentation / springs));
      CHECK(e.pressure >= 0.99 * force / (4 * half * half));
    }
}

namespace {

/// integral of the depth of a 45-degree wedge over a disc around a point of its edge
double wedge_volume(double depth, double radius) {
  constexpr int steps = 2000;
  double sum = 0;
  const double most = std::min(depth, radius);
  for (int i = 0; i < steps; ++i) {
    const double y = most * (i + 0.5) / steps;
    sum += 2 * (depth - y) * 2 * std::sqrt(radius * radius - y * y) * most / steps;
  }
  return sum;
}

/// a cube on the floor, with contact at the point of its own frame that is lowest
SoftPatch cube_at(const Vector3d& down, const Vector3d& place) {
  const Pose turn = Pose::turn(shortest_rotation(down, -Vector3d::UnitZ()));
  const Mesh cube = test::moved(test::box(0.03, 0.03, 0.03), turn);
  const Vector3d foot = turn * place;
  return patch_at(test::floor_board(), test::moved(cube, Pose::translation(-foot)), 0, {0, 0});
}

}  // namespace

TEST_CASE("at corners and edges, the springs under the gap balance the force") {
  const SoftPatch corner = cube_at({1, 1, 1}, {0.015, 0.015, 0.015});
  const SoftPatch edge = cube_at({0, 1, 1}, {0.004, 0.015, 0.015});
  REQUIRE(corner.at_edge);
  REQUIRE(edge.at_edge);
  for (const double force : {0.05, 0.5, 5.0}) {
    const ContactEllipse at_corner = contact_ellipse(corner, force);
    // at a depth d, the section of a cube's corner is a triangle of area 3 sqrt(3) / 2 d^2
    const double deep = std::cbrt(force * springs / (0.5 * std::sqrt(3.0)));
    CHECK(at_corner.indentation == doctest::Approx(deep).epsilon(0.04));
    CHECK(at_corner.pressure == doctest::Approx(at_corner.indentation / springs));
    const ContactEllipse at_edge = contact_ellipse(edge, force);
    CHECK(wedge_volume(at_edge.indentation, edge.radius) ==
          doctest::Approx(force * springs).epsilon(0.15));
    // wider than the area that is certain to touch, according to the model
    CHECK(at_corner.indentation > at_corner.semi_axes[1]);
  }
}

TEST_CASE("a pad much smaller than its patch is pressed evenly") {
  for (const double half : {0.0005, 0.001, 0.0015})
    for (const double turn : {0.0, 0.3}) {
      const Mesh square = pad_of(rectangle(half, half), 0.004, 1);
      const ContactEllipse e =
          contact_ellipse(patch_at(test::floor_board(), square, turn, {0, 0}), 5);
      // sectors of 15 degrees approximate the corners: up to 2.3 % of the area
      CHECK(e.pressure == doctest::Approx(5 / (4 * half * half)).epsilon(0.025));
      const Mesh disc = pad_of(circle(half, 48), 0.004, 2);
      const ContactEllipse d =
          contact_ellipse(patch_at(test::floor_board(), disc, turn, {0, 0}), 5);
      CHECK(d.pressure == doctest::Approx(5 / (pi * half * half)).epsilon(0.01));
    }
}

TEST_CASE("an indentation beyond the height of the layer is reported") {
  const Mesh ball = test::moved(test::icosphere(0.02, 4), Pose::translation({0, 0, 0.02}));
  SoftPatch patch = patch_at(test::floor_board(), ball, 0, {0, 0});
  CHECK(!contact_ellipse(patch, 280).exceeds_layer);
  CHECK(contact_ellipse(patch, 290).exceeds_layer);  // sqrt(283 c / (pi 0.02)) = 3 mm
  // two layers add up their heights; the original uses that of the stiffer layer only
  patch.elastic_a = {.modulus = 0.5 * pad_modulus};
  CHECK(!contact_ellipse(patch, 290).exceeds_layer);
  CHECK(contact_ellipse(patch, 290, ModulusRule::larger).exceeds_layer);
}

TEST_CASE("a radius without points to fit is rejected") {
  const auto a = Shape::make(test::floor_board()), b = Shape::make(test::icosphere(0.01, 3));
  const Pose X_AB = Pose::translation({0, 0, pad_gap - b->bounds().low.z()});
  const auto site =
      soft_sites(a, b, X_AB, {}, {.modulus = pad_modulus}, contact_set(*a, *b, X_AB))[0];
  for (const double radius : {1e-6, 10.0})
    CHECK_THROWS_WITH_AS(
        soft_patch(*site, {.radius = radius}),
        fmt::format("contact patch: within radius {} [m] there is too little of a surface to fit; "
                    "expected more than the gap, and no more than the bodies",
                    radius)
            .c_str(),
        Error);
  CHECK_NOTHROW(soft_patch(*site, {.radius = 0.02}));
}
