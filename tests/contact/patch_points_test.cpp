#include "contact/patch_points.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "base/error.h"

using namespace clench;
using Eigen::Vector2d;

TEST_CASE("a lattice has the places near any site, by rows, each once") {
  const std::vector<Vector2d> sites = {{0, 0}, {0.01, 0.002}};
  const PatchLattice lattice = patch_lattice(sites, 0.005);
  size_t near = 0;
  for (int y = -100; y <= 100; ++y)
    for (int x = -100; x <= 100; ++x) {
      const Vector2d place(x * lattice.spacing, y * lattice.spacing);
      near += std::any_of(sites.begin(), sites.end(),
                          [&](const Vector2d& s) { return (place - s).norm() <= 0.005 + 1e-11; });
    }
  CHECK(lattice.places.size() == near);
  for (size_t i = 1; i < lattice.cells.size(); ++i) {
    const auto &a = lattice.cells[i - 1], &b = lattice.cells[i];
    CHECK((a.y() < b.y() || (a.y() == b.y() && a.x() < b.x())));
    CHECK(lattice.places[i] == b.cast<double>() * lattice.spacing);
  }
}

TEST_CASE("sites may lie as far apart as cells have numbers") {
  const std::vector<Vector2d> sites = {{0, 0}, {0.02, 0.01}};
  for (double radius = 1e-8; radius < 1e10; radius *= 10)
    CHECK(patch_lattice(sites, radius).places.size() <= 2 * 201);
  CHECK_THROWS_WITH_AS(patch_lattice(sites, 1e-9),
                       "contact patch: radius: wanted more than 2e-09 [m], got 1e-09", Error);
  for (const double radius : {1e-30, 5e-324}) CHECK_THROWS_AS(patch_lattice(sites, radius), Error);
}
