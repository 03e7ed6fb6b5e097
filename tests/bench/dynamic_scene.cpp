#include "bench/dynamic_scene.h"

#include <cmath>

#include "clench/base/random.h"
#include "support/meshes.h"
#include "support/shapes.h"

namespace clench::bench {

using Eigen::Vector3d;

DynamicScene stack_of_ten(double gap) {
  DynamicScene scene{.name = "stack of ten"};
  scene.parts.push_back({.size = {1, 1, 0.1}, .X_W = Pose::translation({0, 0, -0.05})});
  for (int i = 0; i < 10; ++i)
    scene.parts.push_back({.size = {0.06, 0.06, 0.04},
                           .mass = 0.44,
                           .X_W = Pose::translation({0, 0, 0.02 + gap + i * (0.04 + gap)})});
  scene.watched = 10;
  return scene;
}

Part ground_part() { return {.size = {2, 2, 0.1}, .X_W = Pose::translation({0, 0, -0.05})}; }

DynamicScene empty_bin(const std::string& name, double half, double height) {
  constexpr double wall = 0.04;
  DynamicScene scene{.name = name};
  scene.parts.push_back(ground_part());
  for (const double side : {-1.0, 1.0}) {
    const double at = side * (half + wall / 2);
    scene.parts.push_back({.size = {wall, 2 * half + 2 * wall, height},
                           .X_W = Pose::translation({at, 0, height / 2})});
    scene.parts.push_back(
        {.size = {2 * half, wall, height}, .X_W = Pose::translation({0, at, height / 2})});
  }
  return scene;
}

DynamicScene boxes_in_a_bin(double) {
  DynamicScene scene = empty_bin("boxes in a bin", 0.15, 0.5);
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vector3d size(random.uniform(0.03, 0.08), random.uniform(0.03, 0.08),
                        random.uniform(0.03, 0.08));
    const Vector3d at(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0.1 + 0.14 * i);
    scene.parts.push_back(
        {.size = size, .mass = 800 * size.prod(), .X_W = {test::random_turn(random), at}});
  }
  scene.watched = static_cast<int>(scene.parts.size()) - 1;
  return scene;
}

DynamicScene slope(double degrees, double mu, double gap) {
  const Pose turn = Pose::turn(degrees * std::numbers::pi / 180, Vector3d::UnitY());
  DynamicScene scene{.name = "slope", .mu = mu, .watched = 1};
  scene.parts.push_back({.size = {4, 1, 0.1}, .X_W = turn});
  scene.parts.push_back({.size = {0.06, 0.06, 0.04},
                         .mass = 0.44,
                         .X_W = turn * Pose::translation({-1.8, 0, 0.07 + gap})});
  return scene;
}

DynamicScene three_fingers(double gap) {
  constexpr double radius = 0.03, length = 0.04, depth = 0.01, press = 5, kp = 2;
  DynamicScene scene{.name = "hand of nine hinges", .mu = 0.8};
  scene.parts.push_back(
      {.form = Form::cylinder, .size = {radius, radius, 0.07}, .mass = 0.3, .X_W = {}});
  for (int finger = 0; finger < 3; ++finger) {
    const Pose turn = Pose::turn(2 * std::numbers::pi * finger / 3, Vector3d::UnitZ());
    for (int l = 0; l < 3; ++l) {
      const double top = 3 * length - l * length, r = radius + gap + depth / 2;
      const int part = static_cast<int>(scene.parts.size());
      scene.parts.push_back({.size = {depth, 0.016, length},
                             .mass = 0.05,
                             .X_W = turn * Pose::translation({r, 0, top - length / 2})});
      // torques that press the middle of the last link
      const double arm = length * (2 - l) + length / 2;
      scene.links.push_back({.part = part,
                             .parent = l == 0 ? -1 : part - 1,
                             .origin = turn * Vector3d(r, 0, top),
                             .axis = turn.rotation * Vector3d(0, 1, 0),
                             .kp = kp,
                             .kd = 0.05,
                             .target = press * arm / kp});
    }
  }
  return scene;
}

static void add_pads(DynamicScene& scene, double half, double force) {
  for (const int side : {-1, 1}) {
    const double x = side * (half + 0.008);
    scene.links.push_back({.part = static_cast<int>(scene.parts.size()),
                           .slides = true,
                           .origin = {x, 0, 0},
                           .axis = {-1.0 * side, 0, 0},
                           .effort = force,
                           .viscous = 100});
    scene.parts.push_back(
        {.size = {0.016, 0.06, 0.04}, .mass = 0.2, .X_W = Pose::translation({x, 0, 0})});
  }
}

DynamicScene pinched_capsule(double force, double gap) {
  DynamicScene scene{.name = "pinched capsule", .mu = 0.7};
  scene.parts.push_back({.form = Form::capsule,
                         .size = {0.004, 0.004, 0.04},
                         .mass = 0.045,
                         .X_W = Pose::turn(std::numbers::pi / 2, Vector3d::UnitX())});
  add_pads(scene, 0.004 + gap, force);
  return scene;
}

DynamicScene critical_grip(double share, double gap) {
  constexpr double force = 10, mass = 0.3;
  DynamicScene scene{.name = "critical friction", .mu = share * mass * gravity / (2 * force)};
  scene.parts.push_back({.size = {0.03, 0.03, 0.03}, .mass = mass, .X_W = {}});
  add_pads(scene, 0.015 + gap, force);
  return scene;
}

// turned about z: rings of (radius, height) from below, between two end points on the axis
static Mesh lathe(const std::vector<std::pair<double, double>>& rings) {
  constexpr int segments = 72;
  Mesh mesh;
  const int count = static_cast<int>(rings.size());
  mesh.vertices.push_back({0, 0, rings.front().second});
  for (const auto& [r, z] : rings)
    for (int s = 0; s < segments; ++s) {
      const double a = 2 * std::numbers::pi * s / segments;
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
    }
  mesh.vertices.push_back({0, 0, rings.back().second});
  const auto at = [&](int ring, int s) { return 1 + ring * segments + s % segments; };
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  for (int s = 0; s < segments; ++s) {
    mesh.triangles.push_back({0, at(0, s + 1), at(0, s)});
    for (int ring = 0; ring + 1 < count; ++ring) {
      mesh.triangles.push_back({at(ring, s), at(ring, s + 1), at(ring + 1, s + 1)});
      mesh.triangles.push_back({at(ring, s), at(ring + 1, s + 1), at(ring + 1, s)});
    }
    mesh.triangles.push_back({last, at(count - 1, s), at(count - 1, s + 1)});
  }
  return mesh;
}

Mesh mesh_of(const Part& part) {
  if (part.form == Form::mesh) return *part.mesh;
  if (part.form == Form::box) return test::box(part.size.x(), part.size.y(), part.size.z());
  const double r = part.size.x(), half = part.size.z() / 2;
  std::vector<std::pair<double, double>> rings;
  if (part.form == Form::cylinder) {
    rings = {{r, -half}, {r, half}};
  } else {
    constexpr int steps = 8;
    for (int i = 1; i <= steps; ++i) {
      const double a = std::numbers::pi / 2 * i / steps;
      rings.push_back({r * std::sin(a), -half - r * std::cos(a)});
    }
    for (int i = steps; i >= 1; --i) rings.push_back({rings[i - 1].first, -rings[i - 1].second});
  }
  Mesh mesh = lathe(rings);
  if (part.form == Form::capsule) {
    mesh.vertices.front().z() = -half - r;
    mesh.vertices.back().z() = half + r;
  }
  return mesh;
}

}  // namespace clench::bench
