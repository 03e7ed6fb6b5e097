// A scene as drafts draw it: meshes on the graphics card, with their poses.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "clench/render/mesh/extent.h"
#include "clench/render/paint/mesh_store.h"
#include "clench/render/view/scene_key.h"
#include "clench/scene/scene.h"

namespace clench {

/// One mesh of a scene, with its pose.
struct PlacedMesh {
  const StoredMesh* mesh = nullptr;
  std::shared_ptr<const Shape> shape = {};  ///< null: not part of a body
  Eigen::Matrix4d to_scene = Eigen::Matrix4d::Identity();
  Eigen::Vector4f paint = Eigen::Vector4f(0, 0, 0, 1);
  bool background = false;
  double distance = 0;    ///< distance of its center from the eye [scene units]
  bool one_side = false;  ///< is only its outer side visible?
};

/// Cones and arrows as one mesh, cached until they or the extent change. Must not outlive its
/// GlContext.
class DraftMarks {
 public:
  /// Null if there are none; valid until the next call.
  const StoredMesh* at(const Scene& scene, const Extent& extent);

 private:
  std::optional<SceneKey> key_;
  Extent extent_;
  std::optional<StoredMesh> mesh_;
};

/// Lengths are in units of its extent.
struct DraftScene {
  Extent extent = {};
  Eye eye = {};
  std::vector<PlacedMesh> solid = {};  ///< nearest first, so that only visible fragments are shaded
  std::vector<PlacedMesh> clear = {};  ///< transparent: farthest first
  const StoredMesh* marks = nullptr;   ///< cones and arrows; null: none
  std::optional<StoredMesh> floor = {};  ///< empty if no floor is visible
};

/// Meshes are valid until the store is trimmed; `eye` is in the world.
/// throws  Stopped
DraftScene load_draft(MeshStore& store, DraftMarks& marks, const Scene& scene, const Extent& extent,
                      const Eye& eye, const Progress& progress);

}  // namespace clench
