#include "clench/render/mesh/extent.h"

#include <doctest/doctest.h>

#include "clench/render/mesh/pieces.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;

namespace {

// all vertices, each time
Extent plain_extent(const Scene& scene) {
  const auto of = [&](bool background) {
    return ball_around([&](const auto& use) {
      for (const DrawMesh& mesh : scene.meshes) {
        if (!mesh.shape || mesh.opacity == 0 || mesh.background != background) continue;
        for (const auto& p : mesh.shape->mesh().vertices)
          use(Eigen::Vector3d(mesh.X_WM.rotation.toRotationMatrix() * p + mesh.X_WM.position));
      }
      for (const DrawCone& cone : scene.cones)
        for (const auto& p : cone_piece(cone).p_W) use(p);
      for (const DrawArrow& arrow : scene.arrows)
        for (const auto& p : arrow_piece(arrow).p_W) use(p);
    });
  };
  if (const auto bodies = of(false)) return *bodies;
  return of(true).value_or(Extent{});
}

// some near, some far from the origin; one in four is background, with some cones and arrows
Scene random_scene(Random& random, const std::vector<std::shared_ptr<const Shape>>& shapes) {
  Scene scene;
  const double away = random.uniform() < 0.3 ? 1e7 : 0;
  const int count = static_cast<int>(random.uniform(0, 6));
  for (int i = 0; i < count; ++i) {
    DrawMesh mesh{.shape = shapes[static_cast<size_t>(random.uniform(0, 4))],
                  .X_WM = random_pose(random, 2)};
    mesh.X_WM.position.x() += away;
    mesh.background = random.uniform() < 0.25;
    if (random.uniform() < 0.1) mesh.opacity = 0;
    if (random.uniform() < 0.1) mesh.shape.reset();
    scene.meshes.push_back(mesh);
  }
  if (random.uniform() < 0.3)
    scene.cones.push_back({.apex = random_point(random), .half_angle = 0.4, .height = 0.3});
  if (random.uniform() < 0.3) scene.arrows.push_back({.tail = random_point(random)});
  return scene;
}

}  // namespace

TEST_CASE("the cached extent equals that of all vertices, bit-exactly") {
  Random random(3);
  std::vector<std::shared_ptr<const Shape>> shapes;
  for (const double size : {1e-4, 0.1, 1.0, 1.5})
    shapes.push_back(Shape::make(moved(potato(random, size), random_pose(random, size))));
  ExtentFinder finder;
  for (int i = 0; i < 300; ++i) {
    Scene scene = random_scene(random, shapes);
    for (int k = 0; k < 3; ++k) {
      const Extent expected = plain_extent(scene), found = finder.find(scene);
      CHECK(found.center == expected.center);
      CHECK(found.scale == expected.scale);
      if (!scene.meshes.empty()) scene.meshes.back().X_WM = random_pose(random, 2);
    }
  }
}

TEST_CASE("a mesh beyond the range of numbers is named, at every call") {
  Scene scene;
  scene.meshes.push_back({.shape = Shape::make(box(1, 1, 1)), .X_WM = {}});
  scene.meshes.push_back({.shape = Shape::make(box(2, 1, 1)), .X_WM = {}});
  scene.meshes[1].X_WM.rotation.x() = 1e160;
  ExtentFinder finder;
  for (int i = 0; i < 2; ++i)
    CHECK_THROWS_WITH_AS(finder.find(scene),
                         "picture: mesh 2: position exceeds the range of numbers", Error);
  scene.meshes[1].X_WM.rotation.x() = 0;
  CHECK(finder.find(scene).scale == plain_extent(scene).scale);
}
