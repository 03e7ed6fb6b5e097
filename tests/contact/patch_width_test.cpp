#include "clench/contact/patch_width.h"

#include <numbers>

using namespace clench;
using Eigen::Matrix2d;
using Eigen::Rotation2Dd;
using Eigen::Vector2d;

namespace {

// the sides of a regular polygon or a rectangle, turned
PatchWidth room_of(const std::vector<double>& half_widths, double step, double turn) {
  PatchWidth out;
  for (size_t i = 0; i < half_widths.size(); ++i) {
    const double angle = turn + step * static_cast<double>(i);
    out.directions.emplace_back(std::cos(angle), std::sin(angle));
    out.half_widths.push_back(half_widths[i]);
  }
  return out;
}

Matrix2d turned_axes(double turn) { return Rotation2Dd(turn).toRotationMatrix(); }

}  // namespace

TEST_CASE("an ellipse within the width is bit-exactly unchanged") {
  const std::array<double, 2> axes = {0.003, 0.004};
  CHECK(make_room(room_of({0.005, 0.006}, std::numbers::pi / 2, 0.3), turned_axes(0.1), axes,
                  true) == axes);
  CHECK(make_room({}, turned_axes(0.1), axes, true) == axes);
}

TEST_CASE("a rectangle bounds each semi-axis separately") {
  for (const double turn : {0.0, 0.4, 2.0}) {
    const PatchWidth room = room_of({2, 3}, std::numbers::pi / 2, turn);
    const auto both = make_room(room, turned_axes(turn), {4, 4}, true);
    CHECK(both[0] == doctest::Approx(2).epsilon(1e-5));
    CHECK(both[1] == doctest::Approx(3).epsilon(1e-5));
    const auto one = make_room(room, turned_axes(turn), {4, 2.5}, true);
    CHECK(one[0] == doctest::Approx(2).epsilon(1e-5));
    CHECK(one[1] == doctest::Approx(2.5).epsilon(1e-5));
    // arbitrary axes do not grow
    const auto circle = make_room(room, turned_axes(turn), {4, 4}, false);
    CHECK(circle[0] == doctest::Approx(2));
    CHECK(circle[1] == doctest::Approx(2));
  }
}

TEST_CASE("within a regular polygon, a circle is bounded to the inscribed circle for any axes") {
  for (const int sides : {2, 3, 4, 6})
    for (const double turn : {0.0, 0.2, 0.5, 1.0}) {
      const PatchWidth room = room_of(std::vector<double>(sides, 1.0), std::numbers::pi / sides, 0);
      const auto circle = make_room(room, turned_axes(turn), {1.5, 1.5}, true);
      for (const double a : circle) CHECK(a == doctest::Approx(1).epsilon(1e-4));
    }
}
