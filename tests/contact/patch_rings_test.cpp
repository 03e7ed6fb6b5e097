#include "clench/contact/patch_rings.h"

#include <numbers>

#include "support/cases.h"
#include "support/curved.h"

using namespace clench;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using std::numbers::pi;

// two bodies that touch at the origin, b above a, turned about z together
PatchRings rings_of(const Mesh& below, const Mesh& above, double turn, double radius,
                    double depth) {
  const auto a = Shape::make(below), b = Shape::make(above);
  const Pose X = Pose::turn(turn, Vector3d::UnitZ());
  // in the sheet's frame of a, the body is below: half a turn about x
  const Pose half = Pose::turn(pi, Vector3d::UnitX());
  const std::vector<Vector3d> site = {Vector3d::Zero()};
  PatchSheet sheet_a(*a, half * X, site, radius), sheet_b(*b, X, site, radius);
  return patch_rings(sheet_a, sheet_b, radius, depth);
}

double area_of(const std::vector<GapPlace>& places, double widest_gap) {
  double sum = 0;
  for (const GapPlace& g : places)
    if (g.gap <= widest_gap) sum += g.area;
  return sum;
}

}  // namespace

TEST_CASE(
    "the areas of places sum to the disc, and those with a gap to the part that both surfaces "
    "cover") {
  for (const double turn : {0.0, 0.4, 2.0}) {
    // a box of 30 mm, touched at the center, an edge and a corner of its face
    const auto box_at = [](double x, double y) {
      return test::moved(test::box(0.03, 0.03, 0.03), Pose::translation({x, y, 0.015}));
    };
    const double radius = 0.004, disc = pi * radius * radius;
    const auto check = [&](const Mesh& body, double expected) {
      const PatchRings rings = rings_of(test::floor_board(), body, turn, radius, 1e-4);
      CHECK(area_of(rings.gap, std::numeric_limits<double>::infinity()) ==
            doctest::Approx(disc).epsilon(1e-9));
      CHECK(area_of(rings.gap, 1) == doctest::Approx(expected * disc).epsilon(1e-9));
      CHECK(rings.shares[1] == doctest::Approx(expected).epsilon(1e-9));
      CHECK(rings.shares[0] == doctest::Approx(1).epsilon(1e-9));
    };
    check(box_at(0, 0), 1);
    check(box_at(0, 0.015), 0.5);
    check(box_at(0.015, 0.015), 0.25);
  }
  // a post narrower than the disc: circles cross its rim at an angle
  const Mesh post = test::moved(test::box(0.002, 0.002, 0.01), Pose::translation({0, 0, 0.005}));
  const PatchRings rings = rings_of(test::floor_board(), post, 0.3, 0.004, 1e-4);
  CHECK(area_of(rings.gap, 1) == doctest::Approx(4e-6).epsilon(1e-3));
}

TEST_CASE("paraboloids overlap in ellipses, and depths sum to the volume under them") {
  const auto bowl = [](double x, double y) { return 0.5 * (50 * x * x + 200 * y * y); };
  const Mesh above = test::graph(bowl, 0.01, 60);
  for (const double depth : {1e-4, 2e-4}) {
    const PatchRings rings = rings_of(test::floor_board(), above, 0.5, 0.005, depth);
    const Vector2d along(std::cos(0.5), std::sin(0.5)), across(-along.y(), along.x());
    const Matrix2d moments = 4 * std::sqrt(pi) * meeting_moments(rings.gap, depth);
    CHECK(along.dot(moments * along) == doctest::Approx(2 * depth / 50).epsilon(0.02));
    CHECK(across.dot(moments * across) == doctest::Approx(2 * depth / 200).epsilon(0.02));
    CHECK(std::abs(along.dot(moments * across)) < 1e-3 * moments.norm());
    // pi / 2 depth a b
    const double volume = pi / 2 * depth * 2 * depth / std::sqrt(50.0 * 200);
    CHECK(depth_of(rings.gap, volume) == doctest::Approx(depth).epsilon(0.02));
  }
  // circles instead of paraboloids
  const PatchRings rings = rings_of(test::floor_board(), above, 0, 0.005, 1e-4);
  const auto round = round_gap(rings.gap, {200, -1}, Matrix2d::Identity());
  for (size_t i = 0; i < round.size(); ++i) {
    const Vector2d p = round[i].place;
    const double curvature = 200 * p.x() * p.x() / p.squaredNorm();
    const double sine = curvature * p.norm();
    if (sine < 0.9)
      CHECK(round[i].gap * (1 + std::sqrt(1 - sine * sine)) ==
            doctest::Approx(sine * p.norm()).epsilon(1e-9));
  }
}

TEST_CASE("without overlap there are no moments and no depth") {
  std::vector<GapPlace> none(3, {Vector2d(1, 0), 1, std::numeric_limits<double>::infinity()});
  CHECK(meeting_moments(none, 0.1).isZero());
  CHECK(depth_of(none, 1) == 0);
  CHECK(depth_of({{Vector2d(1, 0), 2, 0.5}}, 3) == doctest::Approx(2));
  CHECK(depth_of({{Vector2d(1, 0), 2, 0.5}}, 0) == 0);
}
