// Triangles of a scene's meshes, cones and arrows, in the world.
#pragma once
#include <vector>

#include "clench/scene/scene.h"

namespace clench {

/// Triangles of one mesh, cone or arrow.
struct Piece {
  std::vector<Eigen::Vector3d> p_W = {};
  std::vector<Triangle> triangles = {};
  std::vector<Eigen::Vector3f> colors = {};  ///< one, or one per triangle
  SkinPtr skin = {};                         ///< textures over the colors; null: none
  float opacity = 1;
  bool mark = false;        ///< drawn unlit
  bool background = false;  ///< casts no shadow and is ignored by framing
  bool closed = false;      ///< closed and facing outward, so that its inside is never visible
};

/// throws Error naming the mesh, cone, arrow or label and the number that is out of range
void check(const Scene& scene);

/// Triangles in order of their texture: first those without, then those of each texture of a skin;
/// and the count of each.
struct TextureOrder {
  explicit TextureOrder(size_t triangles, const SkinPtr& skin);
  std::vector<int> triangles;
  std::vector<size_t> counts;  ///< [0] without a texture, then by texture
};

/// `number` identifies the mesh in the error for a position that exceeds the range of numbers.
Piece mesh_piece(const DrawMesh& mesh, size_t number);

/// Lateral surface and lid of a cone, and a ball at the apex. A zero angle gives a needle; a flat
/// cone is truncated.
Piece cone_piece(const DrawCone& cone);

/// A rod and its head, which is shorter on short arrows.
Piece arrow_piece(const DrawArrow& arrow);

}  // namespace clench
