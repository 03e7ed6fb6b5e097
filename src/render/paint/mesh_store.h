// Meshes on the graphics card, kept for successive pictures when their bodies move.
#pragma once
#include <list>

#include "clench/render/mesh/draw_list.h"
#include "clench/render/paint/loaded_textures.h"
#include "clench/render/paint/shadows.h"
#include "clench/scene/scene.h"

namespace clench {

/// Corners with smooth normals, relative to the mesh's center and divided by its radius.
struct StoredMesh : LoadedCorners {
  using LoadedCorners::LoadedCorners;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1;
  bool closed = false;   ///< closed, with all triangles counter-clockwise seen from outside
  bool painted = false;  ///< do triangles have individual colors?
  std::vector<TexturedRun> textured = {};  ///< textured triangles, at the end of the indices
  LoadedTextures textures = {};
};

/// Must not outlive its GlContext.
class MeshStore {
 public:
  /// maximum memory kept after a picture [bytes]
  explicit MeshStore(size_t most) : most_(most) {}

  /// The mesh, loaded if necessary; valid until `trim`.
  const StoredMesh& at(const DrawMesh& mesh);
  /// Frees the least recently used meshes until the rest is within the limit.
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
  std::list<Entry> entries_;  // most recently used first
};

/// Triangles as corners, shared by equal corners of a vertex; triangles without area are left out.
/// `colors`: one, or one per triangle.
/// returns  triangles of each texture of the skin, which come last
std::vector<TexturedRun> share_corners(const std::vector<Eigen::Vector3d>& vertices,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<Eigen::Vector3f>& colors,
                                       std::vector<Corner>& corners, std::vector<uint32_t>& indices,
                                       const SkinPtr& skin = {});

}  // namespace clench
