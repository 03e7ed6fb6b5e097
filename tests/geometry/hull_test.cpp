#include "clench/geometry/mesh/hull.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "clench/geometry/mesh/mass.h"
#include "support/linear.h"

using namespace clench;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// corners of the cube [-1, 1]^d
MatrixXd cube(int d) {
  MatrixXd points(d, 1 << d);
  for (int i = 0; i < points.cols(); ++i)
    for (int row = 0; row < d; ++row) points(row, i) = i >> row & 1 ? 1 : -1;
  return points;
}

/// plus and minus the unit vectors
MatrixXd cross_polytope(int d) {
  MatrixXd points(d, 2 * d);
  points << MatrixXd::Identity(d, d), -MatrixXd::Identity(d, d);
  return points;
}

/// the origin and the unit vectors
MatrixXd simplex(int d) {
  MatrixXd points = MatrixXd::Zero(d, d + 1);
  points.rightCols(d) = MatrixXd::Identity(d, d);
  return points;
}

MatrixXd random_points(int d, int count, uint64_t seed) {
  Random random(seed);
  MatrixXd points(d, count);
  for (double& x : points.reshaped()) x = random.normal();
  return points;
}

MatrixXd random_turn(int d, uint64_t seed) {
  Random random(seed);
  return test::random_turn(d, random);
}

void check_facets(const Hull& hull, const MatrixXd& points, double size) {
  REQUIRE(hull.normals.cols() == hull.offsets.size());
  REQUIRE(hull.facets.size() == static_cast<size_t>(hull.offsets.size()));
  // merged facets of qhull contain all points up to a few hundred rounding errors of the
  // coordinates
  const double tolerance = 1e-12 * size;
  for (int f = 0; f < hull.offsets.size(); ++f) {
    CHECK(std::abs(hull.normals.col(f).norm() - 1) < 1e-12);
    const VectorXd heights = (points.transpose() * hull.normals.col(f)).array() - hull.offsets[f];
    CHECK(heights.maxCoeff() < tolerance);
    REQUIRE(hull.facets[f].size() == static_cast<size_t>(hull.dimension));
    for (const int corner : hull.facets[f]) CHECK(std::abs(heights[corner]) < tolerance);
  }
}

}  // namespace

TEST_CASE("cube, cross polytope and simplex have the volume and area of the closed formulas") {
  for (int d = 2; d <= 6; ++d) {
    CAPTURE(d);
    const Hull c = convex_hull(cube(d)), x = convex_hull(cross_polytope(d)),
               s = convex_hull(simplex(d));
    // a handful of facets: sums of few terms
    CHECK(c.volume == doctest::Approx(std::pow(2, d)).epsilon(1e-12));
    CHECK(c.area == doctest::Approx(2 * d * std::pow(2, d - 1)).epsilon(1e-12));
    CHECK(x.volume == doctest::Approx(std::pow(2, d) / factorial(d)).epsilon(1e-12));
    CHECK(x.area ==
          doctest::Approx(std::pow(2, d) * std::sqrt(d) / factorial(d - 1)).epsilon(1e-12));
    CHECK(x.facets.size() == 1u << d);
    CHECK(s.volume == doctest::Approx(1 / factorial(d)).epsilon(1e-12));
    CHECK(s.area == doctest::Approx((d + std::sqrt(d)) / factorial(d - 1)).epsilon(1e-12));
    CHECK(s.facets.size() == d + 1u);
    check_facets(c, cube(d), 1), check_facets(x, cross_polytope(d), 1),
        check_facets(s, simplex(d), 1);
  }
}

TEST_CASE("every point lies behind every facet, and the facet's corners lie on it") {
  for (int d = 2; d <= 6; ++d) {
    const MatrixXd points = random_points(d, 40, d);
    check_facets(convex_hull(points), points, 4);
  }
}

TEST_CASE("a turned, moved and scaled hull is the same hull") {
  for (int d = 2; d <= 6; ++d) {
    const MatrixXd points = random_points(d, 30, 10 + d);
    const Hull plain = convex_hull(points);
    for (const double scale : {1e-6, 1.0, 1e3}) {
      const VectorXd shift = VectorXd::Constant(d, 100 * scale);
      const MatrixXd moved = (scale * random_turn(d, d) * points).colwise() + shift;
      const Hull hull = convex_hull(moved);
      // the shift of 100 sizes costs two digits of sixteen, and the sixth power a few more
      CHECK(hull.volume == doctest::Approx(plain.volume * std::pow(scale, d)).epsilon(1e-11));
      CHECK(hull.area == doctest::Approx(plain.area * std::pow(scale, d - 1)).epsilon(1e-11));
      CHECK(hull.facets.size() == plain.facets.size());
      check_facets(hull, moved, 200 * scale);
    }
  }
}

TEST_CASE("the triangles of a hull enclose its volume, counter-clockwise as seen from outside") {
  for (int seed = 0; seed < 5; ++seed) {
    const MatrixXd points = random_points(3, 60, seed);
    const Hull hull = convex_hull(points);
    Mesh mesh;
    for (int i = 0; i < points.cols(); ++i) mesh.vertices.push_back(points.col(i));
    mesh.triangles = hull_triangles(hull, points);
    CHECK(find_faults(mesh).closed());
    // two sums of some hundred terms
    CHECK(solid_mass(mesh).volume == doctest::Approx(hull.volume).epsilon(1e-12));
  }
}

TEST_CASE("duplicate and inner points change nothing") {
  for (int d = 2; d <= 6; ++d) {
    MatrixXd points(d, 3 * (1 << d) + 1);
    points << cube(d), cube(d), 0.5 * cube(d), VectorXd::Zero(d);
    const Hull hull = convex_hull(points);
    CHECK(hull.volume == doctest::Approx(std::pow(2, d)).epsilon(1e-12));
    check_facets(hull, points, 1);
  }
}

TEST_CASE("a flat set has no hull and reports its rank") {
  for (int d = 2; d <= 6; ++d)
    for (int rank = 0; rank < d; ++rank) {
      const MatrixXd flat =
          (random_turn(d, 7).leftCols(rank) * random_points(rank, 50, 3)).colwise() +
          VectorXd(random_points(d, 1, 5).col(0));
      const Hull hull = convex_hull(flat);
      CAPTURE(d);
      CHECK(hull.rank == rank);
      CHECK_FALSE(hull.full());
      CHECK(hull.volume == 0);
      CHECK(hull.facets.empty());
    }
  CHECK(convex_hull(MatrixXd(6, 0)).rank == 0);
  CHECK(convex_hull(MatrixXd::Constant(3, 1, 5)).rank == 0);
  CHECK(convex_hull(MatrixXd::Constant(3, 9, 0.1)).rank == 0);
  CHECK(convex_hull(simplex(6).leftCols(6)).rank == 5);
}

TEST_CASE("the rank counts directions longer than the tolerance") {
  MatrixXd points = cube(3);
  points.row(2) *= 1e-6;
  CHECK(affine_rank(points) == 3);
  CHECK(affine_rank(points, 1e-5) == 2);
  CHECK(convex_hull(points).volume == doctest::Approx(8e-6).epsilon(1e-9));  // 1e-16 of 1 to 1e-6
}

TEST_CASE("bad points are rejected by index") {
  MatrixXd points = cube(3);
  points(1, 4) = std::nan("");
  CHECK_THROWS_WITH_AS(convex_hull(points),
                       "convex_hull: point 4: coordinates must be finite and within 1e50, got nan",
                       Error);
  CHECK_THROWS_WITH_AS(affine_rank(points),
                       "affine_rank: point 4: coordinates must be finite and within 1e50, got nan",
                       Error);
  points(1, 4) = 1e200;
  CHECK_THROWS_AS(convex_hull(points), Error);
  CHECK_THROWS_WITH_AS(convex_hull(MatrixXd::Zero(1, 4)),
                       "convex_hull: dimension must be in 2..6, got 1", Error);
  CHECK_THROWS_WITH_AS(convex_hull(MatrixXd::Zero(7, 4)),
                       "convex_hull: dimension must be in 2..6, got 7", Error);
}

TEST_CASE("nearly flat sets give a hull or a report of flatness, and never a crash") {
  for (int d = 2; d <= 6; ++d)
    for (double thin = 0.3; thin > 1e-18; thin *= 0.01) {
      MatrixXd points = random_points(d, 40, d);
      points.row(0) *= thin;
      points = random_turn(d, 9) * points;
      try {
        const Hull hull = convex_hull(points);
        CHECK(hull.full() == (thin > 1e-10));
      } catch (const Error& e) {
        FAIL_CHECK(d << " " << thin << " " << e.what());
      }
    }
}
