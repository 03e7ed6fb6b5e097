// Detects whether a scene has changed, so that data prepared for it can be reused.
#pragma once
#include <vector>

#include "clench/scene/scene.h"

namespace clench {

/// The meshes, cones, arrows and floor of a scene, and the parts that its view must show; keeps its
/// shapes alive.
struct SceneKey {
  std::vector<DrawMesh> meshes = {};
  std::vector<DrawCone> cones = {};
  std::vector<DrawArrow> arrows = {};
  std::optional<double> ground = {};
  std::vector<Eigen::Vector3d> spots = {}, held = {};

  explicit SceneKey(const Scene& scene);
  /// bit-exact comparison
  bool matches(const Scene& scene) const;
};

}  // namespace clench
