// Meshes on the graphics card, kept from picture to picture wherever their bodies move.
#pragma once
#include <list>

#include "clench/render/mesh/draw_list.h"
#include "clench/render/paint/loaded_textures.h"
#include "clench/render/paint/shadows.h"
#include "clench/scene/scene.h"

namespace clench {

/// Corners with smooth normals, about the mesh's center and divided by its radius.
struct StoredMesh : LoadedCorners {
  using LoadedCorners::LoadedCorners;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;
  bool closed = false;   ///< a solid whose triangles all run counter-clockwise seen from outside
  bool painted = false;  ///< triangles have colors of their own
  std::vector<TexturedRun> textured = {};  ///< at the end of the indices
  LoadedTextures textures = {};
};

/// Lives inside the life of a GlContext.
class MeshStore {
 public:
  /// bytes that are kept after a picture
  explicit MeshStore(size_t most) : most_(most) {}

  /// Loads it unless it is there; good until `trim`.
  const StoredMesh& at(const DrawMesh& mesh);
  /// Lets go of those not asked for the longest until the rest is within the bound.
  void trim();
  size_t bytes() const { return bytes_; }

 private:
  struct Entry {
    std::shared_ptr<const Shape> shape;
    std::vector<Eigen::Vector3f> colors;
    SkinPtr skin;
    StoredMesh mesh;
    size_t bytes = 0;
  };
  size_t most_, bytes_ = 0;
  std::list<Entry> entries_;  // the last asked for first
};

/// Triangles as corners, each distinct one of a vertex once; triangles without area are left out.
/// `colors`: one, or one per triangle.
/// returns  triangles of each texture of the skin, which come last
std::vector<TexturedRun> share_corners(const std::vector<Eigen::Vector3d>& vertices,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<Eigen::Vector3f>& colors,
                                       std::vector<Corner>& corners, std::vector<uint32_t>& indices,
                                       const SkinPtr& skin = {});

}  // namespace clench
