#include "contact/patch_rim.h"

#include <cmath>
#include <numbers>

using namespace clench;
using Eigen::Vector2d;

namespace {

constexpr double rim_turn = std::numbers::pi;

/// to the sides of a rectangle about the middle, turned
PatchRim rim_of(double half_x, double half_y, double angle, double looked) {
  RayLengths ends, far;
  for (int k = 0; k < PatchRays::count; ++k) {
    const double a = 2 * rim_turn * k / PatchRays::count - angle;
    ends[k] = std::min(half_x / std::max(1e-9, std::abs(std::cos(a))),
                       half_y / std::max(1e-9, std::abs(std::sin(a))));
    far[k] = looked;
  }
  return patch_rim(ends, far, far);
}

}  // namespace

TEST_CASE("an ellipse with room for it stays as it is, to the bit") {
  const std::array<double, 2> axes = {0.7, 1.3};
  const RimEllipse out = make_room(rim_of(1.4, 1.4, 0.3, 5), axes);
  CHECK(out.semi_axes == axes);
  CHECK(out.sure);
  CHECK(make_room(rim_of(9, 9, 0, 1.5), axes).semi_axes == axes);
}

TEST_CASE("each semi-axis gives way by itself, both together where they lie askew") {
  const auto along = make_room(rim_of(0.5, 2, 0, 5), {1, 1.5}).semi_axes;
  CHECK(along[0] == doctest::Approx(0.5));
  CHECK(along[1] == doctest::Approx(1.5));
  const auto square = make_room(rim_of(0.5, 0.5, rim_turn / 4, 5), {1, 1}).semi_axes;
  CHECK(square[0] == doctest::Approx(0.5));
  CHECK(square[1] == doctest::Approx(0.5));
}

TEST_CASE("who cuts an ellipse off where he looked no farther says so") {
  CHECK(make_room(rim_of(0.5, 0.5, 0, 5), {1, 1}).sure);
  const RimEllipse strip = make_room(rim_of(0.5, 9, 0, 2), {1, 1});
  CHECK(strip.semi_axes[0] == doctest::Approx(0.5));
  CHECK(!strip.sure);
  CHECK(rim_of(0.5, 9, 0, 2).any_ended());
  CHECK(!rim_of(9, 9, 0, 2).any_ended());
}

TEST_CASE("the longer side of a rectangle tells the direction") {
  // rays of 15 degrees cut its corners, one more than another
  for (const double angle : {-0.7, 0.0, 0.4, 1.2})
    CHECK(std::abs(std::sin(rim_angle(rim_of(2, 1, angle, 5)) - angle)) < 0.03);
}
