// A scene as triangle corners for the graphics card, in scene units: relative to its center and
// divided by its radius, so that scenes of a millimeter and of a kilometer give the same picture.
#pragma once
#include <optional>
#include <vector>

#include "clench/render/mesh/corner.h"
#include "clench/render/mesh/extent.h"
#include "clench/scene/scene.h"

namespace clench {

/// Triangles of one texture.
struct TexturedRun {
  int first = 0, count = 0;  ///< number of indices
  int texture = 0;           ///< index of the texture; -1: none
  float opacity = 1;         ///< of a transparent run
};

/// A run of indices of one surface, and the same surface in fewer triangles, used for its shadow.
struct Batch {
  int first = 0, count = 0;
  int plain_count = 0;                     ///< triangles before the first with a texture
  std::vector<TexturedRun> textured = {};  ///< the remaining triangles
  int first_caster = 0, caster_count = 0;
  float opacity = 1;
  bool closed = false;  ///< closed and facing outward, so that its inside is never visible
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of its bounding sphere [scene units]
  double radius = 0;
};

/// Lengths are in units of its extent, that of the scene.
struct DrawList : Extent {
  std::vector<Corner> corners;
  std::vector<uint32_t> indices;  ///< three per triangle
  std::vector<Batch> solid;       ///< opaque meshes
  std::vector<Batch> clear;       ///< transparent meshes
  Batch marks;                    ///< friction cones and arrows: transparent, no shadow
  /// a wide level grid, finer below the scene: floor_lines in each direction, row by row
  Batch floor;
  std::optional<double> ground;  ///< its height [scene units]
  std::vector<Batch> behind;     ///< meshes of the background: opaque, without shadow
  size_t floor_corner = 0;       ///< index of the floor's first corner
  std::vector<Texture> textures = {};
};

inline constexpr double floor_reach = 5;  ///< half width of the floor [scene units]
inline constexpr int floor_lines = 113;
/// minimum opacity of an opaque mesh
inline constexpr float solid_from = 0.999f;

/// throws  Error naming the mesh or cone and the value out of range: numbers not finite, opacity
///         outside [0, 1], a wrong count of triangle colors, a cone's axis that is not unit, its
///         half angle outside [0, pi/2)
DrawList make_draw_list(const Scene& scene);

/// Triangles in drawing order, and runs of them with one texture.
struct SortedTriangles {
  std::vector<uint32_t> indices;
  std::vector<TexturedRun> runs;  ///< are all untextured, so that they can be drawn together?
};

/// Triangles of `clear`, the farthest from the eye first; scene units.
SortedTriangles back_to_front(const DrawList& list, const Eye& eye);

}  // namespace clench
