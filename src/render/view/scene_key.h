// Is what a scene shows the same as before? Then what was prepared for it is good for the next
// picture.
#pragma once
#include <vector>

#include "clench/scene/scene.h"

namespace clench {

/// The meshes, cones, arrows and floor of a scene, and what its view must show; keeps its shapes
/// alive.
struct SceneKey {
  std::vector<DrawMesh> meshes = {};
  std::vector<DrawCone> cones = {};
  std::vector<DrawArrow> arrows = {};
  std::optional<double> ground = {};
  std::vector<Eigen::Vector3d> spots = {}, held = {};

  explicit SceneKey(const Scene& scene);
  /// equal to the bit
  bool matches(const Scene& scene) const;
};

}  // namespace clench
