#include "geometry/tree.h"

#include <doctest/doctest.h>

#include "geometry/queries.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

// adds the triangles below a node, each within every box on the way down; returns the depth
int gather(const Shape& shape, int at, std::vector<int>& triangles) {
  const Tree::Node& node = shape.tree().node(at);
  const size_t begin = triangles.size();
  int depth = 1;
  if (node.leaf())
    triangles.push_back(node.triangle);
  else
    depth += std::max(gather(shape, at + 1, triangles), gather(shape, node.right, triangles));
  const double slack = box_slack(shape.bounds(), Vector3d::Zero());
  for (size_t i = begin; i < triangles.size(); ++i)
    for (const Vector3d& p : shape.mesh().corners(triangles[i]))
      CHECK(node.box.squared_distance(p) <= slack * slack);
  return depth;
}

OrientedBox random_box(Random& random) {
  const Pose X = random_pose(random, 1.2);
  const Vector3d half = random_point(random, 0.5).cwiseAbs();
  return {X.matrix(), X.position, half};
}

}  // namespace

TEST_CASE("a tree holds every triangle once, in boxes that hold it, and stays shallow") {
  Random random(1);
  // the last one doubles its coordinates from triangle to triangle
  std::vector<Mesh> meshes = {soup(random, 200), potato(random), ball(1, 20, 40), {}};
  for (int i = 0; i < 90; ++i) {
    const double x = std::pow(2, i);
    for (const double y : {0.0, 1.0, 0.5}) meshes[3].vertices.push_back({x, y * x, y});
    meshes[3].triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  for (const Mesh& mesh : meshes) {
    const auto shape = Shape::make(mesh);
    std::vector<int> triangles;
    const int depth = gather(*shape, 0, triangles);
    std::sort(triangles.begin(), triangles.end());
    REQUIRE(triangles.size() == mesh.triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i) CHECK(triangles[i] == static_cast<int>(i));
    // an eighth at least goes to either side
    CHECK(depth <= 10 + std::log(mesh.triangles.size()) / std::log(8.0 / 7));
  }
}

TEST_CASE("the gap of two boxes is never more than their distance, whatever direction is known") {
  Random random(2);
  int apart = 0, found = 0;
  for (int i = 0; i < 2000; ++i) {
    const OrientedBox a = random_box(random), b = random_box(random);
    const auto as_shape = [](const OrientedBox& x) {
      const Pose X{Eigen::Quaterniond(x.axes), x.centre};
      return Shape::make(moved(box(2 * x.half.x(), 2 * x.half.y(), 2 * x.half.z()), X));
    };
    const double exact = distance(*as_shape(a), *as_shape(b), Pose()).distance;
    const Reach far{std::numeric_limits<double>::infinity()}, touching{0},
        guided{random.uniform(), random_direction(random)};
    for (const Reach& reach : {far, touching, guided})
      CHECK(gap(a, b, reach, 0) <= exact + 1e-14);  // rounding of coordinates of size 3
    // boxes that lie apart are told apart: by faces and edges all are
    apart += exact > 1e-12;
    found += gap(a, b, touching, 0) > 0;
  }
  CHECK(apart > 500);
  CHECK(found == apart);
}
