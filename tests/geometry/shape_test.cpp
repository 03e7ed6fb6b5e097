#include "clench/geometry/tree/shape.h"

#include <doctest/doctest.h>

#include <latch>
#include <thread>

#include "clench/base/error.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

TEST_CASE("a shape has its mesh, faults, mass properties and bounds") {
  const ShapePtr shape = Shape::make(moved(box(1, 2, 2), Pose::translation({5, 0, 0})));
  CHECK(shape->mesh().triangles.size() == 12);
  CHECK(shape->closed());
  CHECK(shape->faults().none());
  CHECK(shape->solid().volume == doctest::Approx(4));
  CHECK(shape->bounds().low == Vector3d(4.5, -1, -1));
  CHECK(shape->center() == Vector3d(5, 0, 0));
  CHECK(shape->radius() == 1.5);
  CHECK(shape->has_triangle(11));
  CHECK_FALSE(shape->has_triangle(12));
  CHECK_FALSE(shape->has_triangle(-1));
}

TEST_CASE("the sphere contains every corner, and the bounds omit unused corners") {
  Random random(1);
  Mesh mesh = moved(potato(random), random_pose(random, 10));
  const Bounds used = mesh.bounds();
  mesh.vertices.push_back({1000, 0, 0});
  const ShapePtr shape = Shape::make(mesh);
  CHECK(shape->bounds().high == used.high);
  for (size_t i = 0; i + 1 < mesh.vertices.size(); ++i)
    CHECK((mesh.vertices[i] - shape->center()).norm() <= shape->radius());
}

TEST_CASE("closed bodies without concave edges are convex") {
  Random random(4);
  const auto convex = [](const Mesh& mesh) { return Shape::make(mesh)->convex(); };
  CHECK(convex(box(1, 2, 3)));
  CHECK(convex(moved(box(1, 2, 3), random_pose(random, 10))));
  CHECK(convex(ball(0.1, 8, 12)));
  CHECK_FALSE(convex(inverted(box(1, 2, 3))));
  CHECK_FALSE(convex(joined(box(1, 1, 1), moved(box(1, 1, 1), Pose::translation({2, 0, 0})))));
  Mesh dented = box(1, 1, 1);
  dented.vertices[0] *= 0.5;
  CHECK_FALSE(convex(dented));
  Mesh open = box(1, 1, 1);
  open.triangles.pop_back();
  CHECK_FALSE(convex(open));
  // too large to be tested
  CHECK_FALSE(convex(ball(0.1, 60, 60)));
}

TEST_CASE("each connected part is named by its first triangle") {
  const Mesh one = ball(1), two = joined(one, moved(one, Pose::translation({5, 0, 0})));
  const int count = static_cast<int>(one.triangles.size());
  CHECK(Shape::make(one)->parts() == std::vector<int>{0});
  CHECK(Shape::make(two)->parts() == std::vector<int>{0, count});
  // corners with equal coordinates connect, as in a file without indices
  Mesh fan;
  fan.vertices = {{0, 0, 0},  {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0},
                  {0, -1, 0}, {2, 2, 2}, {3, 2, 2}, {2, 3, 2}};
  fan.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  CHECK(Shape::make(fan)->parts() == std::vector<int>{0, 2});
}

TEST_CASE("a bad mesh is rejected with the name of its subject") {
  Mesh mesh = box(1, 1, 1);
  mesh.vertices[2].x() = std::nan("");
  CHECK_THROWS_WITH_AS(Shape::make(mesh, "mug.iv"),
                       "mug.iv: vertex 2: coordinates must be finite and within 1000000000 [m], "
                       "got (nan, 0.5, -0.5)",
                       Error);
  CHECK_THROWS_WITH_AS(Shape::make({}), "mesh: at least one triangle expected, got none", Error);
}

TEST_CASE("shapes accept all finite meshes: copies, points, needles, geometric series") {
  Mesh heap;
  for (int i = 0; i < 300; ++i) {
    const int v = static_cast<int>(heap.vertices.size());
    const double x = i < 100 ? 0 : std::pow(2, 0.3 * (i - 205));
    for (const double y : {0.0, i % 3 * x, 0.5 * x}) heap.vertices.push_back({x, y, 0});
    heap.triangles.push_back({v, v + 1, v + 2});
  }
  for (const double scale : {1.0, 1e-15, 0.0}) {
    const ShapePtr shape = Shape::make(scaled(heap, scale));
    CHECK((shape->radius() > 0) == (scale > 0));
    CHECK(&shape->tree() == &shape->tree());
  }
}

TEST_CASE("threads that request the tree of a shape concurrently get the same tree") {
  const ShapePtr shape = Shape::make(ball(1, 30, 60));
  std::array<const Tree*, 8> trees = {};
  {
    std::latch ready(trees.size());
    std::vector<std::jthread> threads;
    for (const Tree*& tree : trees)
      threads.emplace_back([&] {
        ready.arrive_and_wait();
        tree = &shape->tree();
      });
  }
  for (const Tree* tree : trees) CHECK(tree == trees[0]);
  CHECK(trees[0] != nullptr);
}
