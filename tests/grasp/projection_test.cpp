#include "clench/grasp/wrench/projection.h"

#include <limits>

#include "clench/base/error.h"
#include "clench/geometry/tree/shape.h"
#include "clench/grasp/wrench/slice.h"
#include "grasp/wrench_sets.h"

using namespace clench;
using namespace clench::test;

namespace {

Wrenches cross() {
  Wrenches w(6, 12);
  w << Eigen::Matrix<double, 6, 6>::Identity(), -Eigen::Matrix<double, 6, 6>::Identity();
  return w;
}

WrenchSpace tetrahedral(double mu, int edges, WrenchNorm norm = WrenchNorm::l1) {
  std::vector<UnitWrenches> contacts;
  for (const PointContact& c : ball_contacts(solid_directions(4), mu))
    contacts.push_back(unit_wrenches(c, {.edges = edges}));
  return WrenchSpace(contacts, {.norm = norm});
}

double mesh_volume(const Mesh& mesh) {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

// brute-force reference: all facets of the hull in six dimensions, cut by the plane, and the
// corners of the region that they bound
double slow_slice_volume(const WrenchSpace& space,
                         const std::vector<std::pair<int, double>>& fixed) {
  const Hull hull = space.hull();
  std::vector<Eigen::Vector3d> duals;
  for (int f = 0; f < hull.normals.cols(); ++f) {
    double offset = hull.offsets[f];
    Eigen::Vector3d n;
    int next = 0;
    for (int c = 0; c < 6; ++c) {
      bool is_free = true;
      for (const auto& [coordinate, value] : fixed)
        if (coordinate == c) offset -= hull.normals(c, f) * value, is_free = false;
      if (is_free) n[next++] = hull.normals(c, f);
    }
    REQUIRE(offset > 0);  // the slice contains its origin
    duals.push_back(n / offset);
  }
  Eigen::MatrixXd points(3, duals.size());
  for (size_t i = 0; i < duals.size(); ++i) points.col(static_cast<int>(i)) = duals[i];
  const Hull dual = convex_hull(points);
  return convex_hull(dual.normals * dual.offsets.cwiseInverse().asDiagonal()).volume;
}

}  // namespace

TEST_CASE(
    "a section or a projection of a cross polytope is an octahedron, smaller for more distant "
    "sections") {
  const WrenchSpace space({cross()});
  const Projection projection = project(space, {.projected = {3, 4, 5}});
  CHECK(projection.volume == doctest::Approx(8.0 / 6).epsilon(1e-12));
  CHECK(projection.mesh.triangles.size() == 8);
  CHECK(projection.free == std::array{0, 1, 2});
  for (const double at : {0.0, 0.1, 0.5}) {
    const Projection section = project(space, {.fixed = {{0, at}, {4, -at / 2}, {5, 0}}});
    CHECK(section.free == std::array{1, 2, 3});
    CHECK(section.volume == doctest::Approx(std::pow(1 - 1.5 * at, 3) * 8 / 6).epsilon(1e-9));
  }
  // half and half: section in one coordinate, projection of the rest
  const Projection mixed = project(space, {.fixed = {{3, 0.25}}, .projected = {4, 5}});
  CHECK(mixed.volume == doctest::Approx(std::pow(0.75, 3) * 8 / 6).epsilon(1e-9));
}

TEST_CASE("a section of a frictional grasp equals that of all facets of its hull") {
  for (const int edges : {3, 5, 8}) {
    const WrenchSpace space = tetrahedral(0.6, edges);
    for (const auto& fixed :
         std::vector<std::vector<std::pair<int, double>>>{{{3, 0}, {4, 0}, {5, 0}},
                                                          {{3, 0.05}, {4, -0.1}, {5, 0.02}},
                                                          {{0, 0}, {1, 0.1}, {5, 0}}}) {
      const Projection section = project(space, {.fixed = fixed});
      CHECK(section.volume == doctest::Approx(slow_slice_volume(space, fixed)).epsilon(1e-8));
      CHECK(mesh_volume(section.mesh) == doctest::Approx(section.volume).epsilon(1e-12));
      const auto shape = Shape::make(section.mesh, "section");
      CHECK(shape->faults().closed());
      // every corner belongs to the space
      const Hull hull = space.hull();
      for (const Eigen::Vector3d& v : section.mesh.vertices) {
        Vector6d w = Vector6d::Zero();
        for (const auto& [coordinate, value] : fixed) w[coordinate] = value;
        for (int i = 0; i < 3; ++i) w[section.free[i]] = v[i];
        CHECK((hull.normals.transpose() * w - hull.offsets).maxCoeff() < 1e-9);
      }
    }
  }
}

TEST_CASE("projections are hulls of the projected wrenches") {
  const WrenchSpace space = tetrahedral(0.6, 8);
  Eigen::MatrixXd points(3, 32);
  for (int i = 0; i < 4; ++i)
    points.middleCols(8 * i, 8) = space.contacts()[i].edges(std::vector{1, 3, 4}, Eigen::all);
  const Projection projection = project(space, {.projected = {0, 2, 5}});
  CHECK(projection.volume == doctest::Approx(convex_hull(points).volume).epsilon(1e-9));
}

TEST_CASE("round cones and L-infinity have sections, too: round ones contain their pyramids") {
  const std::vector<std::pair<int, double>> fixed = {{3, 0}, {4, 0}, {5, 0}};
  for (const WrenchNorm norm : {WrenchNorm::l1, WrenchNorm::linf}) {
    const double coarse = project(tetrahedral(0.6, 4, norm), {.fixed = fixed}).volume;
    const double fine = project(tetrahedral(0.6, 32, norm), {.fixed = fixed}).volume;
    const double round =
        project(tetrahedral(0.6, round_edges, norm), {.fixed = fixed, .tolerance = 1e-3}).volume;
    CHECK(coarse < fine);
    CHECK(fine < 1.02 * round);  // the mesh of the round one is inside it by its tolerance
    CHECK(round < 1.02 * fine);
  }
  CHECK(project(tetrahedral(0.6, 4, WrenchNorm::linf), {.fixed = fixed}).volume >
        project(tetrahedral(0.6, 4), {.fixed = fixed}).volume);
}

TEST_CASE("flat projections have no volume and no mesh") {
  Wrenches flat = cross();
  flat.row(1).setZero();
  const Projection projection = project(WrenchSpace({flat}), {.projected = {3, 4, 5}});
  CHECK(projection.volume == 0);
  CHECK(projection.mesh.triangles.empty());
  CHECK(project(WrenchSpace(std::vector<Wrenches>()), {.projected = {3, 4, 5}}).volume == 0);
}

TEST_CASE("invalid projections are rejected by name") {
  const WrenchSpace space({cross()});
  const WrenchSpace forces({cross()}, {.coordinates = {0, 1, 2}});
  const auto refuse = [](const WrenchSpace& s, const ProjectionOptions& options, const char* why) {
    CHECK_THROWS_WITH_AS(project(s, options), why, Error);
  };
  refuse(space, {},
         "wrench space: project: expected three free coordinates, got 6: fx, fy, fz, tx, ty, tz");
  refuse(space, {.projected = {0, 1, 2, 3}},
         "wrench space: project: expected three free coordinates, got 2: ty, tz");
  refuse(space, {.fixed = {{0, 0}}, .projected = {0, 1}},
         "wrench space: project: fx is named twice, or is no coordinate of this space");
  refuse(forces, {.projected = {5}},
         "wrench space: project: tz is named twice, or is no coordinate of this space");
  refuse(space, {.projected = {7}}, "wrench space: project: coordinates must be 0 to 5, got 7");
  refuse(space, {.fixed = {{0, 2}, {1, 0}, {2, 0}}},
         "wrench space: project: no wrench of it has fx = 2, fy = 0, fz = 0");
  refuse(WrenchSpace(std::vector<Wrenches>()), {.fixed = {{0, 2}, {1, 0}, {2, 0}}},
         "wrench space: project: no wrench of it has fx = 2, fy = 0, fz = 0");
  refuse(space, {.fixed = {{0, std::numeric_limits<double>::infinity()}, {1, 0}, {2, 0}}},
         "wrench space: project: fx must be finite, got inf");
  refuse(space, {.projected = {3, 4, 5}, .tolerance = 0},
         "wrench space: project: tolerance must be > 0, got 0");
  CHECK(project(forces).volume == doctest::Approx(8.0 / 6).epsilon(1e-12));
}
