#include "bench/heap_scenes.h"

#include <cmath>

#include "clench/base/random.h"
#include "clench/geometry/mesh/mass.h"
#include "support/meshes.h"
#include "support/shapes.h"
#include "support/shared.h"

namespace clench::bench {

using Eigen::Vector3d;

DynamicScene bin_of_boxes(int count) {
  constexpr double density = 800;
  DynamicScene scene = empty_bin("bin of boxes", 0.15, 0.8);
  Random random(11);
  for (int i = 0; i < count; ++i) {
    const Vector3d size(random.uniform(0.03, 0.08), random.uniform(0.03, 0.08),
                        random.uniform(0.03, 0.08));
    const Vector3d at((i & 1 ? 0.075 : -0.075) + random.uniform(-0.003, 0.003),
                      (i & 2 ? 0.075 : -0.075) + random.uniform(-0.003, 0.003),
                      0.08 + 0.145 * (i / 4));
    scene.parts.push_back(
        {.size = size, .mass = density * size.prod(), .X_W = {test::random_turn(random), at}});
  }
  scene.watched = static_cast<int>(scene.parts.size()) - 1;
  return scene;
}

DynamicScene bin_of_scans(int count) {
  constexpr double mass = 0.3;
  DynamicScene scene = empty_bin("bin of scans", 0.25, 1.5);
  if (test::shared().empty()) return {.name = scene.name};
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const char* file : {"003_cracker_box", "005_tomato_soup_can", "006_mustard_bottle",
                           "011_banana", "013_apple", "036_wood_block", "055_baseball"}) {
    Mesh mesh =
        weld(test::read_obj(test::shared() / "data" / "ycb" / (std::string(file) + ".obj")));
    const Vector3d centroid = solid_mass(mesh).centroid;
    for (Vector3d& p : mesh.vertices) p -= centroid;
    meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
  }
  Random random(12);
  for (int i = 0; i < count; ++i) {
    const auto& mesh = meshes[i % meshes.size()];
    const Vector3d at((i & 1 ? 0.125 : -0.125) + random.uniform(-0.003, 0.003),
                      (i & 2 ? 0.125 : -0.125) + random.uniform(-0.003, 0.003),
                      0.15 + 0.25 * (i / 4));
    scene.parts.push_back({.form = Form::mesh,
                           .size = mesh->bounds().size(),
                           .mass = mass,
                           .X_W = {test::random_turn(random), at},
                           .mesh = mesh});
  }
  scene.watched = static_cast<int>(scene.parts.size()) - 1;
  return scene;
}

DynamicScene card_house(int storeys, double gap) {
  constexpr double thick = 0.002, width = 0.06, length = 0.09, lean = 0.3, card_mass = 0.005;
  DynamicScene scene{.name = "card house", .mu = 0.6};
  scene.parts.push_back(ground_part());
  const double reach = length / 2 * std::sin(lean) + thick / 2 * std::cos(lean),
               rise = length / 2 * std::cos(lean) + thick / 2 * std::sin(lean),
               pitch = 4 * reach + 0.01;
  double floor = 0;
  for (int storey = 0; storey < storeys; ++storey) {
    const int pairs = storeys - storey;
    for (int i = 0; i < pairs; ++i) {
      const double middle = pitch * (i - 0.5 * (pairs - 1));
      for (const double side : {-1.0, 1.0})
        scene.parts.push_back(
            {.size = {thick, width, length},
             .mass = card_mass,
             .X_W = Pose::translation({middle + side * (reach + gap / 2), 0, floor + gap + rise}) *
                    Pose::turn(-side * lean, Vector3d::UnitY())});
    }
    floor += 2 * rise + gap;
    scene.parts.push_back({.size = {pitch * (pairs - 1) + 0.04, width, thick},
                           .mass = card_mass * pairs,
                           .X_W = Pose::translation({0, 0, floor + gap + thick / 2})});
    floor += gap + thick;
  }
  scene.watched = static_cast<int>(scene.parts.size()) - 1;
  return scene;
}

DynamicScene plank_tower(int layers, double gap) {
  constexpr double thick = 0.015, width = 0.025, mass = 0.02;
  constexpr double length = 3 * width;
  DynamicScene scene{.name = "plank tower"};
  scene.parts.push_back(ground_part());
  for (int layer = 0; layer < layers; ++layer)
    for (int i = -1; i <= 1; ++i) {
      const double across = i * (width + 0.001), z = gap + layer * (thick + gap) + thick / 2;
      const bool along_x = layer % 2 == 0;
      scene.parts.push_back(
          {.size = along_x ? Vector3d(length, width, thick) : Vector3d(width, length, thick),
           .mass = mass,
           .X_W = Pose::translation(along_x ? Vector3d(0, across, z) : Vector3d(across, 0, z))});
    }
  scene.watched = static_cast<int>(scene.parts.size()) - 1;
  return scene;
}

DynamicScene layer_of_boxes(int side, double gap) {
  constexpr double edge = 0.05, mass = 0.1;
  DynamicScene scene{.name = "layer of boxes"};
  scene.parts.push_back(ground_part());
  for (int i = 0; i < side * side; ++i)
    scene.parts.push_back(
        {.size = {edge, edge, edge},
         .mass = mass,
         .X_W = Pose::translation({(edge + gap) * (i % side - 0.5 * (side - 1)),
                                   (edge + gap) * (i / side - 0.5 * (side - 1)), gap + edge / 2})});
  scene.watched = side * side;
  return scene;
}

}  // namespace clench::bench
