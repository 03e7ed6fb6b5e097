#include "clench/grasp/wrench/facet_complex.h"

#include <Eigen/Core>
#include <optional>

#include "clench/base/random.h"
#include "clench/grasp/wrench/facet_plane.h"
#include "clench/grasp/wrench/first_simplex.h"
#include "support/linear.h"

using namespace clench;

namespace {

// a simplex around the origin, then points one after the other
template <int D>
FacetComplex<D> grown(const Eigen::MatrixXd& points) {
  const auto support = [&](const double* direction, double* point) {
    int best = 0;
    const Eigen::Map<const Eigen::VectorXd> u(direction, D);
    const double reach = (u.transpose() * points).maxCoeff(&best);
    std::copy_n(points.col(best).data(), D, point);
    return reach;
  };
  const Simplex<D> simplex = first_simplex<D>(support, 0, -1e9);
  REQUIRE(simplex.end == SimplexEnd::found);
  FacetComplex<D> complex;
  for (const auto& point : simplex.point) complex.add_point(point);
  complex.start(simplex.plane);
  for (int i = 0; i < complex.facet_count(); ++i) {
    const auto& facet = complex.facet(i);
    double point[D];
    if (!facet.alive() || support(facet.plane.x, point) <= facet.offset() + 1e-9) continue;
    complex.grow(i, point);
    i = -1;
  }
  return complex;
}

template <int D>
void check_surface(FacetComplex<D>& complex) {
  int alive = 0;
  std::optional<bool> first_mirrored;
  for (int index = 0; index < complex.facet_count(); ++index) {
    const auto& facet = complex.facet(index);
    if (!facet.alive()) continue;
    ++alive;
    // the plane contains its corners, and all other points are below it
    for (int p = 0; p < complex.point_count(); ++p) {
      const bool own = std::count(facet.corner, facet.corner + D, p) > 0;
      const double height = dot(facet.plane, complex.point(p));
      CHECK((own ? std::abs(height) < 1e-13 : height < 1e-13));
    }
    CHECK(dot<D>(facet.plane.x, facet.plane.x) == doctest::Approx(1).epsilon(1e-14));
    for (int side = 0; side < D; ++side) {
      // neighbors refer to each other and share all corners but one
      REQUIRE(complex.facet(facet.neighbor[side]).alive());
      const auto& other = complex.facet(facet.neighbor[side]);
      CHECK(std::count(other.neighbor, other.neighbor + D, index) == 1);
      for (int k = 0; k < D; ++k)
        CHECK(std::count(other.corner, other.corner + D, facet.corner[k]) == (k != side));
    }
    // all facets have the same orientation as seen from the origin, except for marked ones
    Eigen::MatrixXd edges(D, D);
    for (int k = 0; k < D; ++k)
      edges.col(k) = Eigen::Map<const Eigen::VectorXd>(complex.point(facet.corner[k]).x, D);
    const bool mirrored = (test::determinant(edges) > 0) == facet.turned;
    CHECK(mirrored == first_mirrored.value_or(mirrored));
    first_mirrored = mirrored;
  }
  CHECK(alive == complex.alive_count());
}

}  // namespace

TEST_CASE(
    "after every growth facets are planes through their corners, and neighbors of their "
    "neighbors") {
  Random random(1);
  Eigen::MatrixXd points(6, 40);
  for (double& x : points.reshaped()) x = random.normal() / 4;
  auto six = grown<6>(points);
  check_surface(six);
  auto three = grown<3>(points.topRows(3));
  check_surface(three);
  // Euler: a surface of triangles
  std::vector<int> used;
  for (int i = 0; i < three.facet_count(); ++i)
    if (three.facet(i).alive())
      used.insert(used.end(), three.facet(i).corner, three.facet(i).corner + 3);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  CHECK(three.alive_count() == 2 * static_cast<int>(used.size()) - 4);
  auto two = grown<2>(points.topRows(2));
  check_surface(two);
}

TEST_CASE("reused memory has no effect on results") {
  Random random(2);
  Eigen::MatrixXd points(4, 30);
  for (double& x : points.reshaped()) x = random.normal() / 4;
  auto complex = grown<4>(points);
  const int alive = complex.alive_count();
  complex.clear();
  CHECK(complex.alive_count() == 0);
  CHECK(complex.point_count() == 0);
  CHECK(grown<4>(points).alive_count() == alive);
}
