// What a scene's meshes, cones and arrows look like as triangles in the world.
#pragma once
#include <vector>

#include "clench/scene/scene.h"

namespace clench {

/// Triangles of one mesh, cone or arrow.
struct Piece {
  std::vector<Eigen::Vector3d> p_W = {};
  std::vector<Triangle> triangles = {};
  std::vector<Eigen::Vector3f> colors = {};  ///< one, or one per triangle
  SkinPtr skin = {};                         ///< over the colors; null: none
  float opacity = 1;
  bool mark = false;        ///< drawn as it is, whatever the light
  bool background = false;  ///< throws no shadow, counts for no frame
  bool closed = false;      ///< faces outward, so that its inside is never seen
};

/// throws Error naming the mesh, cone, arrow or label and the number that is out of range
void check(const Scene& scene);

/// Triangles without an image first, then those of each texture of a skin, in their order; and how
/// many there are of each.
struct TextureOrder {
  explicit TextureOrder(size_t triangles, const SkinPtr& skin);
  std::vector<int> triangles;
  std::vector<size_t> counts;  ///< [0] without an image, then by texture
};

/// `number` names the mesh in an error: when its pose moves it beyond all numbers
Piece mesh_piece(const DrawMesh& mesh, size_t number);

/// The mantle, its lid, and a ball about the apex. A needle when there is no angle; a flat cone is
/// cut off.
Piece cone_piece(const DrawCone& cone);

/// A rod and its head, which is shorter where the arrow is short.
Piece arrow_piece(const DrawArrow& arrow);

}  // namespace clench
