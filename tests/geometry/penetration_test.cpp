#include "clench/geometry/query/penetration.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "clench/base/error.h"
#include "clench/geometry/query/exposed.h"
#include "clench/geometry/query/triangle.h"
#include "support/meshes.h"
#include "support/shared.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

/// Closed prism about z, whose corners lie on a cylinder.
Mesh prism(double radius, double height, int sides) {
  Mesh m;
  for (const double z : {-height / 2, height / 2})
    for (int i = 0; i < sides; ++i) {
      const double t = 2 * std::numbers::pi * i / sides;
      m.vertices.push_back({radius * std::cos(t), radius * std::sin(t), z});
    }
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    m.triangles.push_back({i, j, j + sides});
    m.triangles.push_back({i, j + sides, i + sides});
    if (i == 0 || j == 0) continue;
    m.triangles.push_back({0, j, i});
    m.triangles.push_back({sides, i + sides, j + sides});
  }
  return m;
}

/// the same surface, with each triangle divided into four
Mesh finer(const Mesh& mesh) {
  Mesh out;
  out.vertices = mesh.vertices;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [at, added] =
        middles.try_emplace(std::minmax(i, j), static_cast<int>(out.vertices.size()));
    if (added) out.vertices.push_back((mesh.vertices[i] + mesh.vertices[j]) / 2);
    return at->second;
  };
  for (const auto& [i, j, k] : mesh.triangles) {
    const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
    for (const Triangle& t : {Triangle{i, ij, ki}, {ij, j, jk}, {ki, jk, k}, {ij, jk, ki}})
      out.triangles.push_back(t);
  }
  return out;
}

/// distance to the surface, by a search of all triangles
double brute_distance(const Mesh& mesh, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < mesh.triangles.size(); ++i)
    least = std::min(least, point_triangle(p, mesh.corners(static_cast<int>(i))).distance);
  return least;
}

/// largest depth of random points inside both solids, by winding numbers: a lower bound of the
/// depth
double sampled_depth(Random& random, const Mesh& a, const Mesh& b, int count) {
  const Bounds box_a = a.bounds(), box_b = b.bounds();
  const Vector3d low = box_a.low.cwiseMax(box_b.low), high = box_a.high.cwiseMin(box_b.high);
  double deepest = 0;
  for (int i = 0; i < count; ++i) {
    Vector3d p;
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(low[k], high[k]);
    if (std::abs(winding(a, p)) < 0.5 || std::abs(winding(b, p)) < 0.5) continue;
    deepest = std::max(deepest, brute_distance(a, p));
  }
  return deepest;
}

const PenetrationOptions by_default;

double tolerance(double depth) { return by_default.absolute + by_default.relative * depth; }

/// Properties of every result: its point lies in both solids, at the reported depth.
/// buried  some faces of a are inside it, so the nearest face does not bound the depth
void check_point(const Penetration& found, const Mesh& a, const Mesh& b, bool buried = false) {
  CHECK(found.bound >= found.depth);
  CHECK(found.bound <= found.depth + tolerance(found.depth));
  if (found.depth == 0) return;
  if (!buried) CHECK(brute_distance(a, found.point) == doctest::Approx(found.depth).epsilon(1e-9));
  CHECK(std::abs(winding(a, found.point)) > 0.5);
  const bool inside = std::abs(winding(b, found.point)) > 0.5;
  CHECK((inside || brute_distance(b, found.point) < 1e-9));
}

/// depth of two meshes in one frame, within the tolerance below `expected`
void check_depth(const Mesh& a, const Mesh& b, double expected, bool buried = false) {
  Random random(7);
  const Pose X_WA = random_pose(random, 1);
  const Pose places[] = {{}, X_WA};
  for (const Pose& X : places)
    for (const bool fine : {false, true}) {
      const Mesh own_a = moved(fine ? finer(a) : a, X.inverse());
      const Mesh own_b = fine ? finer(b) : b;
      const Penetration found = penetration(*Shape::make(own_a), *Shape::make(own_b), X.inverse());
      CHECK(found.depth <= expected + 1e-12);
      CHECK(found.depth >= expected - tolerance(expected));
      check_point(found, own_a, moved(own_b, X.inverse()), buried);
    }
}

Mesh placed(const Mesh& mesh, double x, double y, double z) {
  return moved(mesh, Pose::translation({x, y, z}));
}

}  // namespace

TEST_CASE("the depth of two boxes is that of the deepest point of one in the other") {
  const Mesh cube = box(0.06, 0.06, 0.06), bar = box(0.01, 0.01, 0.1);
  // with corners inside, and without: coplanar side faces, a bar through the cube, a plate, crossed
  // bars
  check_depth(cube, placed(bar, 0.001, 0.002, 0.077), 0.003);
  check_depth(cube, placed(cube, 0.05, 0, 0), 0.01);
  check_depth(cube, placed(cube, 0.05, 0.02, 0.01), 0.01);
  check_depth(cube, bar, 0.03);
  check_depth(box(0.06, 0.06, 0.005), bar, 0.0025);
  check_depth(placed(box(0.1, 0.01, 0.01), 0, 0.008, 0), bar, 0.002);
  check_depth(bar, cube, 0.005);
  // one inside the other
  check_depth(cube, placed(box(0.01, 0.01, 0.01), 0.02, 0, 0), 0.015);
  check_depth(placed(box(0.01, 0.01, 0.01), 0.02, 0, 0), cube, 0.005);
  check_depth(cube, cube, 0.03);
}

TEST_CASE("the depth in a prism is at most the radius of its inscribed cylinder") {
  const Mesh cylinder = prism(0.03, 0.08, 48), bar = box(0.1, 0.01, 0.01);
  const double inscribed = 0.03 * std::cos(std::numbers::pi / 48);
  check_depth(cylinder, bar, inscribed);
  // off the axis, by the planes of a face
  check_depth(prism(0.03, 0.08, 4), placed(bar, 0, 0, 0.038), 0.007);
  check_depth(bar, cylinder, 0.005);
}

TEST_CASE("balls: concentric, apart, and one just inside the other") {
  const Mesh large = ball(0.05, 12, 24), small = ball(0.01, 8, 16);
  const double inscribed = brute_distance(large, {0, 0, 0});
  check_depth(large, small, inscribed);
  check_depth(small, large, brute_distance(small, {0, 0, 0}));
  const Penetration beside =
      penetration(*Shape::make(large), *Shape::make(small), Pose::translation({0.055, 0, 0}));
  CHECK(beside.depth > 0.0045);
  CHECK(beside.depth <= 0.005);
  CHECK(penetration(*Shape::make(large), *Shape::make(small), Pose::translation({0.061, 0, 0}))
            .depth == 0);
}

TEST_CASE("a cavity is outside: the depth in a shell is at most half its thickness") {
  const Mesh shell = joined(box(0.1, 0.1, 0.1), inverted(box(0.08, 0.08, 0.08)));
  check_depth(shell, placed(box(0.02, 0.02, 0.05), 0, 0, 0.05), 0.005);
  check_depth(shell, placed(box(0.02, 0.02, 0.05), 0, 0, 0.066), 0.005);
  check_depth(shell, placed(box(0.02, 0.02, 0.05), 0, 0, 0.073), 0.002);
  CHECK(penetration(*Shape::make(shell), *Shape::make(box(0.02, 0.02, 0.05)), {}).depth == 0);
}

TEST_CASE("faces inside a union of parts do not belong to its surface") {
  const Mesh bar = box(0.01, 0.01, 0.2);
  // parts that overlap, that adjoin, and one inside another
  const Mesh overlapping =
      joined(placed(box(0.06, 0.06, 0.06), -0.01, 0, 0), placed(box(0.06, 0.06, 0.06), 0.01, 0, 0));
  check_depth(overlapping, bar, 0.03, true);
  check_depth(overlapping, placed(bar, 0, 0.03, 0), 0.005, true);
  check_depth(joined(placed(box(0.03, 0.06, 0.06), -0.015, 0, 0),
                     placed(box(0.03, 0.06, 0.06), 0.015, 0, 0)),
              bar, 0.03, true);
  check_depth(joined(placed(box(0.03, 0.02, 0.06), -0.015, 0, 0),
                     placed(box(0.03, 0.06, 0.06), 0.015, 0, 0)),
              placed(bar, -0.004, 0, 0), std::hypot(0.01, 0.001), true);
  check_depth(joined(box(0.06, 0.06, 0.06), box(0.02, 0.02, 0.02)), bar, 0.03, true);
  // a cross of two beams: the deepest point has equal distances from its four inner edges
  check_depth(joined(box(0.06, 0.02, 0.06), box(0.02, 0.06, 0.06)), bar, std::hypot(0.01, 0.01),
              true);
}

TEST_CASE(
    "random bodies: no sampled point is deeper, and the reported point has the reported depth") {
  Random random(3);
  for (int i = 0; i < 30; ++i) {
    const Mesh a = potato(random, 0.05, 5), b = potato(random, i % 2 ? 0.05 : 0.02, 5);
    const Pose X_AB = random_pose(random, 0.06);
    const Mesh b_A = moved(b, X_AB);
    const Penetration found = penetration(*Shape::make(a), *Shape::make(b), X_AB);
    check_point(found, a, b_A);
    const double sampled = sampled_depth(random, a, b_A, 1000);
    CHECK(sampled <= found.bound + 1e-12);
    CHECK(sampled <= found.depth + tolerance(found.depth));
    if (sampled > 0) CHECK(found.depth > 0);
  }
}

TEST_CASE(
    "overlapping solids have a positive depth, however small, and touching solids have none") {
  Random random(5);
  const Mesh a = potato(random, 0.05, 6), b = potato(random, 0.03, 6);
  const auto shape_a = Shape::make(a), shape_b = Shape::make(b);
  for (int i = 0; i < 15; ++i) {
    // along a line until they touch, then slightly farther
    const Eigen::Quaterniond turn = random_turn(random);
    const Vector3d along = random_direction(random);
    const auto at = [&](double s) { return Pose{turn, s * along}; };
    double in = 0, out = 0.2;
    while (out - in > 1e-15) {
      const double middle = (in + out) / 2;
      (colliding(*shape_a, *shape_b, at(middle)) ? in : out) = middle;
    }
    CHECK(penetration(*shape_a, *shape_b, at(out)).depth == 0);
    for (const double deep : {1e-3, 1e-5, 1e-7, 1e-9}) {
      const Penetration found = penetration(*shape_a, *shape_b, at(in - deep));
      CHECK(found.depth > 0);
      CHECK(found.depth < 1.01 * deep + 1e-12);
      CHECK(found.bound < found.depth + tolerance(found.depth));
    }
  }
}

TEST_CASE("touching faces, edges and corners have no depth") {
  const auto cube = Shape::make(box(0.06, 0.06, 0.06)), bar = Shape::make(box(0.01, 0.01, 0.1));
  Random random(6);
  for (const Vector3d& p : {Vector3d(0, 0, 0.08), Vector3d(0.035, 0, 0), Vector3d(0.035, 0.035, 0),
                            Vector3d(0.035, 0.01, 0.08), Vector3d(0.035, 0.035, 0.08)}) {
    CHECK(penetration(*cube, *bar, Pose::translation(p)).depth == 0);
    CHECK(penetration(*bar, *cube, Pose::translation(-p)).depth == 0);
  }
  // the depth of a mesh that is not convex is not bounded by planes
  const auto shell = Shape::make(joined(box(0.06, 0.06, 0.06), inverted(box(0.04, 0.04, 0.04))));
  CHECK(penetration(*shell, *bar, Pose::translation({0.002, 0.001, 0.08})).depth == 0);
}

TEST_CASE("nothing is inside an open mesh, but its surface can penetrate a closed one") {
  Mesh open = box(0.06, 0.06, 0.06);
  open.triangles.pop_back();
  const auto cup = Shape::make(open), bar = Shape::make(box(0.01, 0.01, 0.1));
  CHECK(penetration(*cup, *bar, {}).depth == 0);
  // its bottom crosses the bar; the solid that it would enclose does not count
  CHECK(penetration(*bar, *cup, {}).depth == doctest::Approx(0.005).epsilon(1e-3));
  Mesh sheet = box(0.06, 0.06, 0.06);
  sheet.triangles = {sheet.triangles[0], sheet.triangles[1]};
  const Penetration found =
      penetration(*bar, *Shape::make(sheet), Pose::translation({0, 0, 0.077}));
  CHECK(found.depth == doctest::Approx(0.003).epsilon(1e-6));
}

TEST_CASE("depths of meshes of a micrometer and of a kilometer scale with size") {
  Random random(8);
  const Mesh a = potato(random, 1, 5), b = potato(random, 0.5, 5);
  const Pose X{random_turn(random), {0.6, 0.5, 0.3}};
  const double depth = penetration(*Shape::make(a), *Shape::make(b), X).depth;
  REQUIRE(depth > 0.1);
  for (const double size : {1e-5, 1e3}) {
    const Penetration found =
        penetration(*Shape::make(scaled(a, size)), *Shape::make(scaled(b, size)),
                    {X.rotation, size * X.position}, {.absolute = 1e-6 * size});
    CHECK(found.depth / size == doctest::Approx(depth).epsilon(2e-3));
  }
}

TEST_CASE("a search with a short queue keeps the tolerance") {
  Random random(11);
  for (int i = 0; i < 3; ++i) {
    const auto a = Shape::make(potato(random)), b = Shape::make(potato(random));
    const Pose X{random_turn(random), {0.5, 0.2, 0.1}};
    const Penetration longer = penetration(*a, *b, X);
    REQUIRE(longer.depth > 0);
    for (const size_t regions : {size_t{0}, size_t{3}, size_t{30}}) {
      const Penetration found = penetration(*a, *b, X, {.max_regions = regions});
      CHECK(found.depth >= longer.depth - 1e-6 - 1e-3 * longer.depth);
      CHECK(found.depth <= longer.bound + 1e-12);
      CHECK(found.bound >= longer.depth - 1e-12);
      CHECK(found.bound <= found.depth * (1 + 1e-3) + 1e-6 + 1e-12);
    }
  }
}

TEST_CASE("a shape stores the boundary of its union, unless its computation is stopped") {
  Mesh both = box(1, 1, 1);
  const Mesh other = box(1, 1, 1);
  const int first = static_cast<int>(both.vertices.size());
  for (const Vector3d& p : other.vertices) both.vertices.push_back(p + Vector3d(0.5, 0.25, 0.125));
  for (const Triangle& t : other.triangles)
    both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  const auto shape = Shape::make(both);
  struct Silent : Watcher {
    void show(double, std::string_view) override {}
  };
  const auto watcher = std::make_shared<Silent>();
  watcher->stop();
  CHECK_THROWS_AS(exposed_surface(*shape, Progress(watcher)), Stopped);
  const auto kept = exposed_surface(*shape);
  CHECK(kept->shape);
  CHECK(exposed_surface(*shape) == kept);
}

TEST_CASE("tolerances must be above 0, and a watcher stops the search") {
  const auto cube = Shape::make(box(1, 1, 1));
  CHECK_THROWS_WITH_AS(penetration(*cube, *cube, {}, {.absolute = 0}),
                       "penetration: expected tolerances > 0, got 0 and 0.001", Error);
  CHECK_THROWS_WITH_AS(penetration(*cube, *cube, {}, {.relative = -1}),
                       "penetration: expected tolerances > 0, got 1e-06 and -1", Error);
  struct Silent : Watcher {
    void show(double, std::string_view) override {}
  };
  const auto watcher = std::make_shared<Silent>();
  Random random(1);
  const auto round = Shape::make(potato(random));
  const PenetrationOptions watched{.relative = 1e-6, .progress = Progress(watcher)};
  const Pose X = Pose::translation({0.5, 0.2, 0.1});
  const double depth = penetration(*round, *round, X, watched).depth;
  watcher->stop();
  CHECK_THROWS_AS(penetration(*round, *round, X, watched), Stopped);
  watcher->take_stop();
  CHECK(penetration(*round, *round, X, watched).depth == depth);
}

TEST_CASE("real meshes: no sampled point of a finger is deeper in a scan") {
  REQUIRE_SHARED();
  Random random(9);
  for (const char* name : {"011_banana.obj", "065-c_cups.obj"}) {
    const auto scan = Shape::make(read_obj(shared() / "data" / "ycb" / name));
    const auto finger = Shape::make(prism(0.008, 0.06, 24));
    for (int i = 0; i < 2; ++i) {
      const Vector3d& p = scan->mesh().vertices[random.bits() % scan->mesh().vertices.size()];
      const Pose X{random_turn(random), p};
      const Penetration found = penetration(*scan, *finger, X);
      CHECK((found.depth > 0 || !scan->closed()));
      for (int k = 0; k < 500; ++k) {
        const Vector3d q_B = random_pose(random, 0.03).position;
        const Vector3d q = X * q_B;
        if (contains(*finger, q_B) && contains(*scan, q))
          CHECK(closest_point(*scan, q).distance <= found.bound + 1e-12);
      }
    }
  }
}
