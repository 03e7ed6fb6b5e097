#include "clench/contact/patch_fit.h"

#include "clench/base/error.h"
#include "support/curved.h"

using namespace clench;
using Eigen::Vector3d;

namespace {

constexpr double scale = 0.0035;  // [m]

// points of z = height(x, y) over a disc, like the points of a patch
std::vector<Vector3d> disc_of(const std::function<double(double, double)>& height) {
  std::vector<Vector3d> points;
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j) {
      const double x = i * scale / 8, y = j * scale / 8;
      if (i * i + j * j <= 64) points.push_back({x, y, height(x, y)});
    }
  return points;
}

// height of the lower side of a ball whose center is above the origin, tilted by an angle about y
double tilted_ball(double radius, double angle, double x, double y) {
  const double u = x - radius * std::sin(angle);
  return radius * std::cos(angle) - std::sqrt(radius * radius - u * u - y * y);
}

void check_curvatures(const SurfaceFit& fit, double first, double second, double tolerance) {
  CHECK(std::abs(fit.curvatures[0] - first) <= tolerance);
  CHECK(std::abs(fit.curvatures[1] - second) <= tolerance);
}

}  // namespace

TEST_CASE("balls, sockets and cylinders of any size and tilt are fitted exactly") {
  for (const double radius : {0.0045, 0.02, 0.5})
    for (const double angle : {0.0, 0.05, 0.15}) {
      const auto ball = [&](double x, double y) { return tilted_ball(radius, angle, x, y); };
      const auto socket = [&](double x, double y) { return -ball(x, y); };
      const auto rod = [&](double x, double) { return tilted_ball(radius, angle, x, 0); };
      const double k = 1 / radius, rounding = 1e-7 * k;
      check_curvatures(fit_quadric(disc_of(ball), scale), k, k, rounding);
      check_curvatures(fit_quadric(disc_of(socket), scale), -k, -k, rounding);
      const SurfaceFit along = fit_quadric(disc_of(rod), scale);
      check_curvatures(along, k, 0, rounding);
      CHECK(std::abs(along.directions.col(1).y()) == doctest::Approx(1));
      // at the foot point of the fit, not exactly below the origin
      CHECK(std::abs(along.normal.x() - std::sin(angle)) < 0.002);
      CHECK(along.residual < 1e-9 * scale);
    }
}

TEST_CASE("a plane has no curvature, and its normal gives its tilt") {
  const auto plane = [](double x, double y) { return 1e-4 + 0.3 * x - 0.2 * y; };
  const SurfaceFit fit = fit_quadric(disc_of(plane), scale);
  check_curvatures(fit, 0, 0, 1e-6);
  CHECK((fit.normal - Vector3d(-0.3, 0.2, 1).normalized()).norm() < 1e-9);
}

TEST_CASE("the axes of a turned saddle are found, with a negative curvature along the hollow one") {
  for (const double angle : {0.0, 0.4, 1.5, 2.8}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto saddle = [&](double x, double y) {
      const double u = c * x + s * y, v = c * y - s * x;
      return 0.5 * (30 * u * u - 20 * v * v);
    };
    const SurfaceFit fit = fit_quadric(disc_of(saddle), scale);
    // the sections are parabolas, which the fit approximates by circles: an error of about (k
    // scale)^2 / 8
    check_curvatures(fit, 30, -20, 0.05);
    CHECK(std::abs(fit.directions.col(0).dot(Vector3d(c, s, 0))) ==
          doctest::Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("the jet and the quadric agree with each other") {
  if (!has_fit_jet()) {
    CHECK_THROWS_WITH_AS(fit_jet({}, 1),
                         "contact patch: this build has no CGAL; use the fit 'quadric'", Error);
    return;
  }
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    // any two curvatures down to radii of 15 mm, any axes, any tilt up to some 10 degrees
    const double k1 = random.uniform(-66, 66), k2 = random.uniform(-66, 66);
    const double angle = random.uniform(0, 3), tilt_x = random.uniform(-0.2, 0.2),
                 tilt_y = random.uniform(-0.2, 0.2);
    const double c = std::cos(angle), s = std::sin(angle);
    const auto height = [&](double x, double y) {
      const double u = c * x + s * y, v = c * y - s * x;
      return tilt_x * x + tilt_y * y + 0.5 * (k1 * u * u + k2 * v * v);
    };
    const auto points = disc_of(height);
    const SurfaceFit ours = fit_quadric(points, scale), theirs = fit_jet(points, scale);
    // the quadric approximates parabolas by circles: an error of (k scale)^2 / 4 of k, at most 1.3
    // %, and a tilt
    const double tolerance = 0.02 * std::max(std::abs(k1), std::abs(k2));
    CHECK((ours.curvatures - theirs.curvatures).cwiseAbs().maxCoeff() < tolerance);
    CHECK(ours.normal.dot(theirs.normal) > 1 - 1e-5);
    if (std::abs(k1 - k2) > 20)
      CHECK(std::abs(ours.directions.col(0).dot(theirs.directions.col(0))) > 0.999);
  }
  CHECK_THROWS_WITH_AS(fit_jet(std::vector<Vector3d>(14), 1),
                       "contact patch: a jet needs at least 15 points, got 14", Error);
}

TEST_CASE("directions without information stay flat, and too few points are rejected") {
  // a row along x contains no information about y
  std::vector<Vector3d> row;
  for (int i = -8; i <= 8; ++i)
    row.push_back({i * scale / 8, 0, tilted_ball(0.02, 0, i * scale / 8, 0)});
  check_curvatures(fit_quadric(row, scale), 50, 0, 0.01);
  CHECK_THROWS_WITH_AS(fit_quadric(std::vector<Vector3d>(2), 1),
                       "contact patch: a surface needs at least 3 points, got 2", Error);
}

TEST_CASE("a ridge leaves a residual, and a ball does not") {
  const auto ridge = [](double x, double) { return std::abs(x); };
  const SurfaceFit fit = fit_quadric(disc_of(ridge), scale);
  CHECK(fit.residual > 0.2 * fit.relief);
  const auto round = [](double x, double y) { return tilted_ball(0.004, 0, x, y); };
  CHECK(fit_quadric(disc_of(round), scale).residual < 1e-9 * scale);
}
