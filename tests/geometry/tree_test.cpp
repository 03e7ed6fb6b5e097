#include "clench/geometry/tree/tree.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "clench/geometry/query/placement.h"
#include "clench/geometry/query/queries.h"
#include "clench/geometry/tree/triangle_lanes.h"
#include "geometry/one_box.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

// collects the triangles below a box, and checks that all boxes above contain them; returns the
// depth
int gather(const Shape& shape, int bundle, int lane, std::vector<int>& triangles) {
  const Tree& tree = shape.tree();
  const BoxBundle& boxes = tree.boxes(bundle);
  const size_t begin = triangles.size();
  int depth = 1;
  const int child = boxes.child[lane];
  if (child & 1) {
    for (const int t : tree.leaf(child >> 1).triangle)
      if (t >= 0) triangles.push_back(t);
  } else {
    for (int i = 0; i < 8; ++i)
      if (tree.boxes(child >> 1).child[i] >= 0)
        depth = std::max(depth, 1 + gather(shape, child >> 1, i, triangles));
  }
  const BoxOf<double> straight = one_box<double>(boxes, lane);
  const double rounding = rounding_of(shape.bounds(), Vector3d::Zero());
  for (size_t i = begin; i < triangles.size(); ++i)
    for (const Vector3d& p : shape.mesh().corners(triangles[i])) {
      const Vector3d local = p - Vector3d::Map(tree.center());
      for (int k = 0; k < 3; ++k) {
        const Vector3d stored(boxes.axes[3 * k][lane], boxes.axes[3 * k + 1][lane],
                              boxes.axes[3 * k + 2][lane]),
            center(boxes.center[0][lane], boxes.center[1][lane], boxes.center[2][lane]);
        CHECK(std::abs(stored.dot(local - center)) - boxes.half[k][lane] <= rounding);
        // the box converted to double precision contains the same
        const auto& axis = straight.axis[k];
        CHECK(std::abs(Vector3d(axis.x, axis.y, axis.z).dot(local - center)) <=
              straight.half[k] + rounding);
      }
    }
  return depth;
}

}  // namespace

TEST_CASE("a tree contains every triangle once, in boxes that contain it, and has a small depth") {
  Random random(1);
  // the coordinates of the last one double from triangle to triangle
  std::vector<Mesh> meshes = {soup(random, 200), potato(random), ball(1, 20, 40), {}};
  for (int i = 0; i < 90; ++i) {
    const double x = std::pow(2, i - 62);
    for (const double y : {0.0, 1.0, 0.5}) meshes[3].vertices.push_back({x, y * x, y});
    meshes[3].triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  meshes.push_back(moved(scaled(meshes[1], 1e-6), Pose::translation({1e-3, 0, 0})));
  meshes.push_back(moved(meshes[0], Pose::translation({1000, -2000, 3000})));
  for (const Mesh& mesh : meshes) {
    const auto shape = Shape::make(mesh);
    std::vector<int> triangles;
    const int depth = gather(*shape, 0, 0, triangles);
    std::sort(triangles.begin(), triangles.end());
    REQUIRE(triangles.size() == mesh.triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i) CHECK(triangles[i] == static_cast<int>(i));
    // eight children per node: a few levels, or as many as the doublings require
    CHECK(depth <= (&mesh == &meshes[3] ? 40 : 6));
  }
}

namespace {

ShapePtr shape_of(const BoxOf<double>& b) {
  Mesh mesh = box(2 * b.half[0], 2 * b.half[1], 2 * b.half[2]);
  Eigen::Matrix3d axes;
  for (int k = 0; k < 3; ++k) axes.col(k) = Vector3d(b.axis[k].x, b.axis[k].y, b.axis[k].z);
  for (Vector3d& p : mesh.vertices) p = axes * p + Vector3d(b.center.x, b.center.y, b.center.z);
  return Shape::make(mesh);
}

BoxBundle random_boxes(Random& random) {
  BoxBundle boxes;
  for (int i = 0; i < 8; ++i) {
    const Pose X = random_pose(random, 1.2);
    const Eigen::Matrix3d axes = X.matrix();
    for (int k = 0; k < 3; ++k) {
      for (int m = 0; m < 3; ++m) boxes.axes[3 * k + m][i] = static_cast<float>(axes(m, k));
      boxes.center[k][i] = static_cast<float>(X.position[k]);
      boxes.half[k][i] = static_cast<float>(std::abs(0.5 * random.normal()));
    }
    boxes.size[i] = 1;
  }
  return boxes;
}

}  // namespace

TEST_CASE("gaps of boxes never exceed their distance, and separate all boxes that are apart") {
  Random random(2);
  using F = Lanes<float, 4>;
  // rounding bound of precision.h, for coordinates below 8
  const double slack = 64 * 0x1p-24 * 8;
  int apart = 0, found = 0;
  for (int i = 0; i < 40; ++i) {
    const BoxBundle boxes = random_boxes(random), others = random_boxes(random);
    for (int one = 0; one < 8; ++one) {
      const BoxOf<float> box = one_box<float>(others, one);
      const BoxOf<F> eight = load_boxes<F>(boxes);
      float faces[8], axes[8], edges[8];
      box_gaps(eight, box).store(faces);
      axis_gaps(eight, box).store(axes);
      edge_gaps(eight, box).store(edges);
      const auto other = shape_of(one_box<double>(others, one));
      for (int lane = 0; lane < 8; ++lane) {
        const double exact =
            distance(*shape_of(one_box<double>(boxes, lane)), *other, Pose()).distance;
        for (const float gap : {faces[lane], axes[lane], edges[lane]}) CHECK(gap <= exact + slack);
        CHECK(axes[lane] <= faces[lane] + slack);
        // by the separating axes of two boxes; a gap along edges shrinks with the angle between
        // them
        apart += exact > 0.05;
        found += exact > 0.05 && std::max(axes[lane], edges[lane]) > 0;
      }
    }
  }
  CHECK(apart > 500);
  CHECK(found == apart);
}
