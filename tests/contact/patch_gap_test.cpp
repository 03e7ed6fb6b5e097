#include "contact/patch_gap.h"

#include <functional>
#include <numbers>

using namespace clench;
using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

constexpr double between_rays = 2 * std::numbers::pi / PatchRays::count;

PatchRays rays_of(double radius) {
  const Vector2d site(0, 0);
  return patch_rays({1, 0}, std::span(&site, 1), radius);
}

GapProfile profile_of(const PatchRays& rays, const std::function<double(Vector2d)>& gap) {
  RayHeights a, b;
  for (int k = 0; k < PatchRays::count; ++k) {
    a.end[k] = b.end[k] = rays.lengths[k];
    for (int i = 0; i < PatchRays::places; ++i) {
      a.height[k][i] = gap(rays.lengths[k] * PatchRays::part(i) * rays.directions[k]);
      b.height[k][i] = 0.5;
    }
  }
  return gap_profile(rays, a, b);
}

// slowly, over small squares
Matrix2d moments_of(double radius, const std::function<bool(Vector2d)>& inside) {
  Matrix2d sum = Matrix2d::Zero();
  double area = 0;
  const double step = radius / 400;
  for (double x = -radius; x <= radius; x += step)
    for (double y = -radius; y <= radius; y += step) {
      const Vector2d p(x, y);
      if (p.norm() <= radius && inside(p)) sum += p * p.transpose(), area += 1;
    }
  return sum / area;
}

}  // namespace

TEST_CASE("a cone meets over a circle: a polygon of the rays, exactly") {
  const PatchRays rays = rays_of(2);
  for (const double depth : {0.01, 0.1, 0.7, 1.1}) {
    const double r = depth / 0.6;
    const Matrix2d found =
        overlap(profile_of(rays, [](Vector2d p) { return 0.6 * p.norm(); }), depth);
    const Matrix2d wanted = r * r * (2 + std::cos(between_rays)) / 12 * Matrix2d::Identity();
    CHECK((found - wanted).norm() < 1e-12);
  }
}

TEST_CASE("paraboloids meet over ellipses, up to the end of the neighbourhood") {
  const PatchRays rays = rays_of(2);
  for (const Vector2d& k : {Vector2d(1, 1), Vector2d(3, 1), Vector2d(0.5, 0), Vector2d(0.2, -1)})
    for (const double depth : {0.01, 0.1, 0.4}) {
      const Vector2d bend = k.cwiseMax(0);
      const auto gap = [&](Vector2d p) { return 0.5 * bend.dot(p.cwiseAbs2()); };
      const Matrix2d found = overlap(profile_of(rays, gap), depth);
      const Matrix2d wanted = moments_of(2, [&](Vector2d p) { return gap(p) <= depth; });
      // the rays cut off 1 % of the moments of a circle, more of long ellipses, and the corners of a
      // strip that the neighbourhood ends; chords of a parabola between the places 4 %
      const bool strip = bend.minCoeff() == 0;
      CHECK((found - wanted).norm() < (strip ? 0.5 : 0.2) * wanted.norm());
      // circles instead of parabolas: a slope of 45 degrees makes 7 % of the width
      const Matrix2d round = overlap(gap_profile(rays, k), depth);
      CHECK((round - found).norm() < 0.2 * found.norm());
    }
}

TEST_CASE("edges, tilted half planes and corners are seen as they lie") {
  const PatchRays rays = rays_of(1);
  const double none = std::numeric_limits<double>::infinity();
  for (const double angle : {0.0, 0.2, 0.7}) {
    const Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    const auto edge = [&](Vector2d p) { return std::abs(across.dot(p)); };
    const auto half = [&](Vector2d p) {
      return across.dot(p) < -1e-12 ? none : 0.3 * across.dot(p);
    };
    for (const auto& gap :
         {std::function<double(Vector2d)>(edge), std::function<double(Vector2d)>(half)}) {
      const Matrix2d found = overlap(profile_of(rays, gap), 0.15);
      const Matrix2d wanted = moments_of(1, [&](Vector2d p) { return gap(p) <= 0.15; });
      // of a narrow strip the rays see a rhomb, half of the moments, or a sector
      CHECK(found.determinant() < 2.5 * wanted.determinant());
      CHECK(found.determinant() > 0.2 * wanted.determinant());
      CHECK(along.dot(found * along) > across.dot(found * across));
    }
  }
}

TEST_CASE("the ends of rays are those of the neighbourhoods of all sites") {
  const std::vector<Vector2d> sites = {{-1, 0}, {1, 0}};
  const PatchRays rays = patch_rays({1, 0}, sites, 1.5);
  CHECK(rays.lengths[0] == doctest::Approx(2.5));
  CHECK(rays.lengths[PatchRays::count / 4] == doctest::Approx(std::sqrt(1.25)));
  CHECK(rays.directions[PatchRays::count / 4].y() == doctest::Approx(1));
  CHECK(PatchRays::part(0) == 0);
  CHECK(PatchRays::part(1) == doctest::Approx(1.0 / 16));
  CHECK(PatchRays::part(PatchRays::places - 1) == 1);
  // nothing there: nothing meets
  RayHeights empty;
  for (auto& row : empty.height) row.fill(std::numeric_limits<double>::infinity());
  CHECK(overlap(gap_profile(rays, empty, empty), 0.1).isZero());
}

TEST_CASE(
    "depths sum to the volume under cones, bowls and wedges, and to none where nothing meets") {
  const PatchRays rays = rays_of(2);
  const double pi = std::numbers::pi;
  for (const double depth : {0.02, 0.3, 1.1, 3.0}) {
    // of a cone of slope 0.6, cut off at the end of the rays
    const auto cone = profile_of(rays, [](Vector2d p) { return 0.6 * p.norm(); });
    const double reach = std::min(2.0, depth / 0.6);
    const double volume = pi * reach * reach * (depth - 0.4 * reach);
    CHECK(*depth_of(cone, volume) == doctest::Approx(depth));
    // of a bowl: straight between the places, which lie on it
    const auto bowl = profile_of(rays, [](Vector2d p) { return 0.25 * p.squaredNorm(); });
    const double rim = std::min(4.0, 4 * depth);  // squared
    const double below = pi * rim * (depth - 0.125 * rim);
    CHECK(*depth_of(bowl, below) == doctest::Approx(depth).epsilon(0.03));
    CHECK(*depth_of(bowl, 0) == 0);
  }
  RayHeights empty;
  for (auto& row : empty.height) row.fill(std::numeric_limits<double>::infinity());
  CHECK(!depth_of(gap_profile(rays, empty, empty), 1e-9));
}

TEST_CASE("the moments of a star are those of the polygon of its ends") {
  RayLengths ends;
  ends.fill(1.5);
  const Matrix2d circle = star_moments(ends);
  CHECK((circle - 2.25 * (2 + std::cos(between_rays)) / 12 * Matrix2d::Identity()).norm() < 1e-12);
  ends.fill(0);
  CHECK(star_moments(ends).isZero());
}
