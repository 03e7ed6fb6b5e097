// A scene as drafts draw it: meshes on the graphics card, where they stand.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "clench/render/mesh/extent.h"
#include "clench/render/paint/mesh_store.h"
#include "clench/render/view/scene_key.h"
#include "clench/scene/scene.h"

namespace clench {

/// One mesh of a scene, where it stands.
struct PlacedMesh {
  const StoredMesh* mesh = nullptr;
  std::shared_ptr<const Shape> shape = {};  ///< null: not of a body
  Eigen::Matrix4d to_scene = Eigen::Matrix4d::Identity();
  Eigen::Vector4f paint = Eigen::Vector4f(0, 0, 0, 1);
  bool background = false;
  double distance = 0;    ///< of its center from the eye [scene units]
  bool one_side = false;  ///< is all that can be seen
};

/// Cones and arrows as one mesh, kept until they or the extent change. Lives inside the life of a
/// GlContext.
class DraftMarks {
 public:
  /// Null where there is none; good until the next call.
  const StoredMesh* at(const Scene& scene, const Extent& extent);

 private:
  std::optional<SceneKey> key_;
  Extent extent_;
  std::optional<StoredMesh> mesh_;
};

/// In the units of its extent.
struct DraftScene {
  Extent extent = {};
  Eye eye = {};
  std::vector<PlacedMesh> solid =
      {};  ///< nearest first, so that light is found once for what is seen
  std::vector<PlacedMesh> clear = {};    ///< seen through: farthest first
  const StoredMesh* marks = nullptr;     ///< cones and arrows; null: none
  std::optional<StoredMesh> floor = {};  ///< empty where none is seen
};

/// Meshes are good until the store is trimmed; `eye` is of the world.
/// throws  Stopped
DraftScene load_draft(MeshStore& store, DraftMarks& marks, const Scene& scene, const Extent& extent,
                      const Eye& eye, const Progress& progress);

}  // namespace clench
