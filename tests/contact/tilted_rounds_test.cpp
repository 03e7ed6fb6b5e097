// Contacts of flat parts of round solids that tilt away from their support.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "clench/contact/contact_set.h"
#include "clench/geometry/query/round_gap.h"
#include "support/meshes.h"

namespace clench::test {

using Eigen::Vector3d;

static ShapePtr round_shape(const Round& round) {
  Mesh mesh = ball(1, 6, 12);
  for (Vector3d& p : mesh.vertices) p = support(round, p.normalized());
  RoundPieces rounds;
  rounds.pieces.push_back(
      {.solid = round, .X_SR = {}, .first = 0, .count = static_cast<int>(mesh.triangles.size())});
  return Shape::make(std::move(mesh), "solid", {}, rounds);
}

static constexpr double tilt_threshold = 1e-4, min_gap = 4e-5,
                        tilt_slack = tilt_threshold - min_gap;
// contacts closer than this count as one [m]
static constexpr double merged = 2e-4;

static std::vector<Vector3d> contact_points(const Shape& a, const Shape& b, const Pose& X_AB) {
  std::vector<Vector3d> out;
  for (const Touch& touch :
       contact_set(a, b, X_AB,
                   {.threshold = tilt_threshold, .merge_radius = merged, .max_per_patch = 64})) {
    CHECK(touch.gap < tilt_threshold);
    CHECK(std::abs((touch.p_b - touch.p_a).norm() - touch.gap) < 1e-9);
    out.push_back(touch.p_a);
  }
  return out;
}

static double distance_to_segment(const Vector3d& p, const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  const double size = way.squaredNorm();
  const double s = size > 0 ? std::clamp((p - from).dot(way) / size, 0.0, 1.0) : 0;
  return (p - from - s * way).norm();
}

// Largest distance of a point of one set from all lines between points of the other set.
static double apart_from(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double out = 0;
  for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const Vector3d& p : *from) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& q : *to)
        for (const Vector3d& r : *to) nearest = std::min(nearest, distance_to_segment(p, q, r));
      out = std::max(out, nearest);
    }
  return out;
}

// Extent of the points along a unit direction [m].
static double extent_along(const std::vector<Vector3d>& points, const Vector3d& along) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3d& p : points)
    low = std::min(low, along.dot(p)), high = std::max(high, along.dot(p));
  return high - low;
}

// Contact points at angles from 0 to `last`: between steps they move by no more than `most`.
// along  direction in which extent_at returns the extent
static void sweep_tilt(double last, int steps, double most, const Vector3d& along,
                       const std::function<std::vector<Vector3d>(double)>& points_at,
                       const std::function<double(double)>& extent_at) {
  std::vector<Vector3d> before;
  for (int i = 0; i <= steps; ++i) {
    const double angle = last * i / steps;
    const std::vector<Vector3d> points = points_at(angle);
    REQUIRE(!points.empty());
    if (i > 0) CHECK(apart_from(before, points) <= most + 2 * merged);
    CHECK(std::abs(extent_along(points, along) - extent_at(angle)) < 3 * merged);
    before = points;
  }
  CHECK(before.size() == 1);
}

// Length of a flat part that stays in contact if it drops by `drop` along its length: all of it up
// to a drop of `slack`, nothing from four times that on.
static double length_near(double stick_length, double drop) {
  if (drop <= tilt_slack) return stick_length;
  return std::max(0.0, stick_length * (4 * tilt_slack / drop - 1) / 3);
}

// A solid above the plane z = 0 whose lowest point has the least gap.
static Pose above_plane(const Round& round, const Eigen::Quaterniond& turn) {
  const double reach = -(turn * support(round, turn.conjugate() * -Vector3d::UnitZ())).z();
  return {turn, {0.013, 0.007, reach + min_gap}};
}

static ShapePtr plane_slab() {
  return Shape::make(moved(box(1, 1, 0.1), Pose::translation({0, 0, -0.05})));
}

static Eigen::Quaterniond about(const Vector3d& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

static constexpr double quarter_turn = 1.5707963267948966;
static constexpr double stick_length = 0.06, stick_radius = 0.015;
static const Round sticks[] = {Round::capsule_of(stick_radius, stick_length),
                               Round::cylinder_of(stick_radius, stick_length)};
// The near length is (4 slack / sin a - length) / 3: its slope is largest where it is all near, at
// sin a = slack / length, and is 4/3 length^2 / slack there.
static const double slope_of_tilt = 4 * stick_length * stick_length / (3 * tilt_slack);

TEST_CASE("the far end of a stick that tilts on a slab moves towards the near end") {
  const auto slab = plane_slab();
  constexpr int steps = 2000;
  const double last = 4.5 * tilt_slack / stick_length;
  for (const Round& round : sticks) {
    const auto stick = round_shape(round);
    sweep_tilt(
        last, steps, slope_of_tilt * last / steps, Vector3d::UnitY(),
        [&](double angle) {
          return contact_points(*slab, *stick,
                                above_plane(round, about(Vector3d::UnitX(), angle + quarter_turn)));
        },
        [&](double angle) { return length_near(stick_length, stick_length * std::sin(angle)); });
  }
}

TEST_CASE("the shared length of sticks side by side shrinks as they tilt or cross") {
  constexpr int steps = 2000;
  for (const Round& a : sticks)
    for (const Round& b : sticks) {
      const auto first = round_shape(a), second = round_shape(b);
      const double away = 2 * stick_radius + min_gap;
      const double last = 4.5 * tilt_slack / stick_length;
      // tilted in the plane of both axes: the lower end keeps its gap
      sweep_tilt(
          last, steps, slope_of_tilt * last / steps, Vector3d::UnitZ(),
          [&](double angle) {
            const double lift = stick_radius / std::cos(angle) + stick_radius +
                                min_gap / std::cos(angle) + stick_length / 2 * std::tan(angle);
            Pose X{about(Vector3d::UnitY(), angle), {lift, 0, 0}};
            // moved to the least gap along x
            for (int i = 0; i < 20; ++i)
              X.position.x() -= gap_between({a, {}}, {b, X}).gap - min_gap;
            return contact_points(*first, *second, X);
          },
          [&](double angle) { return length_near(stick_length, stick_length * std::sin(angle)); });
      // crossed: the distance of the axes reaches the threshold at s sin a = reach
      const double reach = std::sqrt(std::pow(2 * stick_radius + tilt_threshold, 2) - away * away);
      const double widest = 4.5 * 2 * reach / stick_length;
      sweep_tilt(
          widest, steps, 2 * stick_length * stick_length / (3 * reach) * widest / steps,
          Vector3d::UnitZ(),
          [&](double angle) {
            return contact_points(*first, *second, {about(Vector3d::UnitX(), angle), {away, 0, 0}});
          },
          [&](double angle) {
            const double near = 2 * reach / std::max(std::sin(angle), 1e-9);
            return near >= stick_length ? stick_length
                                        : std::max(0.0, (4 * near - stick_length) / 3);
          });
    }
}

TEST_CASE("the rim of a can that tilts on its cap leaves a slab along a chord") {
  const Round round = Round::cylinder_of(0.03, 0.08);
  const auto can = round_shape(round), slab = plane_slab();
  constexpr int steps = 4000;
  const double width = 0.06, last = 4.5 * tilt_slack / width;
  // The near part of the diameter moves by up to 4/3 width / slack per radian, in diameters; the
  // chord ends on the rim follow as the arc cosine, which is steepest at the ends of its range.
  const double share = std::min(1.0, 4 * width / (3 * tilt_slack) * last / steps);
  sweep_tilt(
      last, steps, 0.03 * std::acos(1 - 2 * share), Vector3d::UnitY(),
      [&](double angle) {
        return contact_points(*slab, *can, above_plane(round, about(Vector3d::UnitX(), angle)));
      },
      [&](double angle) { return length_near(width, width * std::sin(angle)); });
}

TEST_CASE("the shared cap of two cans shrinks as one tilts, continuously") {
  const Round low = Round::cylinder_of(0.03, 0.1), high = Round::cylinder_of(0.02, 0.05);
  const auto a = round_shape(low), b = round_shape(high);
  constexpr int steps = 4000;
  const double width = 0.04, last = 4.5 * tilt_slack / width;
  for (const double aside : {0.0, 0.025}) {
    const double share = std::min(1.0, 4 * width / (3 * tilt_slack) * last / steps);
    std::vector<Vector3d> before;
    for (int i = 0; i <= steps; ++i) {
      const double angle = 1e-7 + last * i / steps;
      Pose X{about(Vector3d::UnitX(), angle), {aside, 0, 0.08}};
      for (int k = 0; k < 20; ++k)
        X.position.z() -= gap_between({low, {}}, {high, X}).gap - min_gap;
      const auto points = contact_points(*a, *b, X);
      REQUIRE(!points.empty());
      if (i > 0)
        CHECK(apart_from(before, points) <= 2 * 0.03 * std::acos(1 - 2 * share) + 2 * merged);
      before = points;
    }
    CHECK(before.size() == 1);
  }
}

TEST_CASE("a stick on the edge of a box keeps its near part as it turns across the edge") {
  const auto slab = plane_slab();
  const double outward = 0.7;
  for (const Round& round : sticks) {
    const auto stick = round_shape(round);
    // the stick lies along the edge x = 0.5, above it at 40 degrees
    const Vector3d up(std::sin(outward), 0, std::cos(outward));
    const double away = stick_radius + min_gap;
    const double reach = std::sqrt(std::pow(stick_radius + tilt_threshold, 2) - away * away);
    const double widest = 4.5 * 2 * reach / stick_length;
    constexpr int steps = 2000;
    sweep_tilt(
        widest, steps, 2 * stick_length * stick_length / (3 * reach) * widest / steps,
        Vector3d::UnitY(),
        [&](double angle) {
          const Pose X{about(up, angle) * about(Vector3d::UnitX(), quarter_turn),
                       Vector3d(0.5, 0.02, 0) + away * up};
          return contact_points(*slab, *stick, X);
        },
        [&](double angle) {
          // along the edge: a length / cos a of the edge is next to the stick
          const double near = 2 * reach / std::max(std::sin(angle), 1e-9),
                       all = stick_length / std::cos(angle);
          return near >= all ? all : std::max(0.0, (4 * near - all) / 3);
        });
  }
}

}  // namespace clench::test
