#include "clench/geometry/mesh/mesh.h"

#include <doctest/doctest.h>

#include <limits>

#include "clench/base/error.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;

namespace {

// every triangle with separate vertices, as in files without indices
Mesh exploded(const Mesh& mesh) {
  Mesh out;
  for (const Triangle& t : mesh.triangles) {
    const int first = static_cast<int>(out.vertices.size());
    for (const int v : t) out.vertices.push_back(mesh.vertices[v]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

}  // namespace

TEST_CASE("bounds and area of a box equal the formulas") {
  const Mesh mesh = box(1, 2, 3);
  CHECK(mesh.bounds().low == Eigen::Vector3d(-0.5, -1, -1.5));
  CHECK(mesh.bounds().size() == Eigen::Vector3d(1, 2, 3));
  CHECK(mesh.bounds().center() == Eigen::Vector3d::Zero());
  CHECK(mesh.area() == doctest::Approx(22));
  CHECK(mesh.bounds().holds({0.5, 1, 1.5}));
  CHECK_FALSE(mesh.bounds().holds({0.5, 1.01, 1.5}));
  CHECK(Mesh().bounds().empty());
  CHECK(Mesh().area() == 0);
}

TEST_CASE("closed meshes have no faults, with any number of connected parts") {
  CHECK(find_faults(box(1, 1, 1)).none());
  CHECK(find_faults(ball(1)).none());
  CHECK(find_faults(joined(ball(1), box(1, 1, 1))).none());
  CHECK(find_faults(inverted(ball(1))).none());
  CHECK(find_faults(box(1, 1, 1)).describe() == "no faults");
}

TEST_CASE("each fault is counted separately") {
  Mesh open = box(1, 1, 1);
  open.triangles.pop_back();
  CHECK(find_faults(open).open_edges == 3);
  CHECK_FALSE(find_faults(open).closed());
  CHECK(find_faults(open).describe() == "3 open edges");

  Mesh flipped = box(1, 1, 1);
  std::swap(flipped.triangles[5][0], flipped.triangles[5][1]);
  CHECK(find_faults(flipped).tangled_edges == 3);
  CHECK(find_faults(flipped).open_edges == 0);
  CHECK_FALSE(find_faults(flipped).closed());

  Mesh twice = box(1, 1, 1);
  twice.triangles.push_back({3, 0, 2});  // the first one, with another starting corner
  CHECK(find_faults(twice).duplicate_triangles == 1);
  CHECK(find_faults(twice).tangled_edges == 3);
  CHECK(find_faults(twice).describe() == "3 tangled edges, 1 duplicate triangle");

  Mesh unused = box(1, 1, 1);
  unused.vertices.push_back({9, 9, 9});
  CHECK(find_faults(unused).closed());
  CHECK_FALSE(find_faults(unused).none());
  CHECK(find_faults(unused).describe() == "1 unused vertex");

  Mesh degenerate = box(1, 1, 1);
  degenerate.triangles.push_back({1, 1, 4});
  CHECK(find_faults(degenerate).degenerate_triangles == 1);
  CHECK(find_faults(degenerate).closed());  // a triangle that repeats a vertex has no open edges
  degenerate.vertices.push_back(0.3 * degenerate.vertices[0] + 0.7 * degenerate.vertices[1]);
  degenerate.triangles.push_back({0, 1, 8});  // three collinear points
  CHECK(find_faults(degenerate).degenerate_triangles == 2);
}

TEST_CASE("welding equal vertices closes a mesh of separate triangles, and keeps the order") {
  for (const Mesh& mesh : {box(1, 2, 3), ball(0.3), joined(ball(1), box(3, 3, 3))}) {
    const Mesh apart = exploded(mesh);
    CHECK(find_faults(apart).open_edges == 3 * static_cast<int>(apart.triangles.size()));
    int dropped = -1;
    const Mesh welded = weld(apart, 0, &dropped);
    CHECK(dropped == 0);
    CHECK(find_faults(welded).none());
    CHECK(welded.vertices.size() == mesh.vertices.size());
    REQUIRE(welded.triangles.size() == mesh.triangles.size());
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      CHECK(welded.corners(t) == mesh.corners(t));
  }
}

TEST_CASE("zero and minus zero are the same coordinate") {
  Mesh mesh;
  mesh.vertices = {{0, 1, 2}, {-0.0, 1, 2}, {1, 0, 0}, {1, -0.0, -0.0}, {3, 3, 3}};
  mesh.triangles = {{0, 2, 4}, {1, 3, 4}, {0, 1, 4}};
  int dropped = 0;
  const Mesh welded = weld(mesh, 0, &dropped);
  CHECK(welded.vertices.size() == 3);
  CHECK(dropped == 1);
  CHECK(welded.triangles[1] == Triangle{0, 1, 2});
}

TEST_CASE("every vertex is merged into the first kept vertex within the tolerance") {
  Random random(1);
  for (const double tolerance : {0.0, 1e-12, 0.02, 0.3, 100.0}) {
    Mesh mesh = soup(random, 60, 0.1);
    mesh.vertices.push_back({1e9, 0, 0});
    for (int i = 0; i < 40; ++i)
      mesh.vertices.push_back(mesh.vertices[3 * i] + random_point(random, 0.5 * tolerance));
    // brute-force reference
    std::vector<Eigen::Vector3d> kept;
    for (const auto& p : mesh.vertices) {
      bool near = false;
      for (const auto& q : kept) near = near || (p - q).norm() <= tolerance;
      if (!near) kept.push_back(p);
    }
    CHECK(weld(mesh, tolerance).vertices == kept);
  }
}

TEST_CASE("welding works with tolerances far below or above the coordinates") {
  Mesh mesh = scaled(box(1, 1, 1), 1e20);
  CHECK(weld(exploded(mesh), 1e-300).vertices.size() == 8);
  CHECK(weld(exploded(mesh), 5e-324).vertices.size() == 8);
  CHECK(weld(exploded(mesh), 1e300).vertices.size() == 1);
  CHECK(weld(exploded(mesh), 1e300).triangles.empty());
  CHECK_THROWS_WITH_AS(weld(mesh, -1), "weld: tolerance must be >= 0 [m], got -1", Error);
  CHECK_THROWS_AS(weld(mesh, std::nan("")), Error);
  mesh.triangles[3][1] = 8;
  CHECK_THROWS_WITH_AS(weld(mesh), "weld: triangle 3: vertex index must be in 0..7, got 8", Error);
  CHECK_THROWS_WITH_AS(find_faults(mesh),
                       "find_faults: triangle 3: vertex index must be in 0..7, got 8", Error);
}

TEST_CASE("a bad mesh is rejected with the number of the vertex or triangle") {
  const Mesh good = box(1, 1, 1);
  check_mesh(good, "good.obj");
  Mesh bad = good;
  bad.vertices[5].y() = std::nan("");
  CHECK_THROWS_WITH_AS(check_mesh(bad, "bad.obj"),
                       "bad.obj: vertex 5: coordinates must be finite and within 1000000000 [m], "
                       "got (0.5, nan, 0.5)",
                       Error);
  bad.vertices[5].y() = -std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(check_mesh(bad, "bad.obj"), Error);
  bad.vertices[5].y() = 1e200;
  CHECK_THROWS_AS(check_mesh(bad, "bad.obj"), Error);
  bad = good;
  bad.triangles[7][2] = -1;
  CHECK_THROWS_WITH_AS(check_mesh(bad, "bad.obj"),
                       "bad.obj: triangle 7: vertex index must be in 0..7, got -1", Error);
  bad.triangles.clear();
  CHECK_THROWS_WITH_AS(check_mesh(bad, "bad.obj"),
                       "bad.obj: at least one triangle expected, got none", Error);
}

TEST_CASE("faults of arbitrary triangles equal a brute-force count") {
  Random random(21);
  for (int n = 0; n < 200; ++n) {
    Mesh mesh;
    const int vertices = 3 + static_cast<int>(random.uniform() * 6);
    for (int v = 0; v < vertices; ++v)
      mesh.vertices.emplace_back(random.normal(), random.normal(), random.normal());
    for (int t = 0; t < 12; ++t) {
      Triangle triangle;
      for (int& v : triangle) v = static_cast<int>(random.uniform() * vertices);
      mesh.triangles.push_back(triangle);
    }
    int open = 0, tangled = 0, duplicates = 0;
    const auto repeats = [](const Triangle& t) {
      return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    };
    for (int low = 0; low < vertices; ++low)
      for (int high = low + 1; high < vertices; ++high) {
        int forward = 0, backward = 0;
        for (const Triangle& t : mesh.triangles)
          for (int k = 0; k < 3 && !repeats(t); ++k) {
            forward += t[k] == low && t[(k + 1) % 3] == high;
            backward += t[k] == high && t[(k + 1) % 3] == low;
          }
        open += forward + backward == 1;
        tangled += forward + backward > 1 && !(forward == 1 && backward == 1);
      }
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      bool earlier = false;
      for (size_t j = 0; j < i; ++j)
        earlier = earlier || std::is_permutation(mesh.triangles[i].begin(), mesh.triangles[i].end(),
                                                 mesh.triangles[j].begin());
      duplicates += earlier;
    }
    const MeshFaults faults = find_faults(mesh);
    CHECK(faults.open_edges == open);
    CHECK(faults.tangled_edges == tangled);
    CHECK(faults.duplicate_triangles == duplicates);
  }
}
