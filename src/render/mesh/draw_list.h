// A scene as triangle corners ready for the graphics card, in the scene's own units: moved to its
// center and divided by its radius, so that a millimeter and a kilometer make the same picture.
#pragma once
#include <optional>
#include <vector>

#include "clench/render/mesh/corner.h"
#include "clench/render/mesh/extent.h"
#include "clench/scene/scene.h"

namespace clench {

/// Triangles of one texture.
struct TexturedRun {
  int first = 0, count = 0;  ///< of indices
  int texture = 0;           ///< its number; -1: none
  float opacity = 1;         ///< of what is seen through
};

/// A run of indices that belong together, and the same surface in fewer triangles, which throw its
/// shadow.
struct Batch {
  int first = 0, count = 0;
  int plain_count = 0;                     ///< those before the first with a texture
  std::vector<TexturedRun> textured = {};  ///< the others
  int first_caster = 0, caster_count = 0;
  float opacity = 1;
  bool closed = false;  ///< faces outward, so that its inside is never seen
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of a ball around it [scene units]
  double radius = 0;
};

/// In the units of its extent, that of the scene.
struct DrawList : Extent {
  std::vector<Corner> corners;
  std::vector<uint32_t> indices;  ///< three a triangle
  std::vector<Batch> solid;       ///< meshes that hide what is behind them
  std::vector<Batch> clear;       ///< meshes that one sees through
  Batch marks;                    ///< friction cones and arrows: seen through, no shadow
  Batch floor;  ///< a wide level net, finer below the scene: floor_lines each way, row by row
  std::optional<double> ground;  ///< its height [scene units]
  std::vector<Batch> behind;     ///< meshes that are background: solid, throw no shadow
  size_t floor_corner = 0;       ///< the floor's first
  std::vector<Texture> textures = {};
};

inline constexpr double floor_reach = 5;  ///< half width of the floor [scene units]
inline constexpr int floor_lines = 113;
/// the least opacity through which nothing shines
inline constexpr float solid_from = 0.999f;

/// throws  Error naming the mesh or cone and what is out of range: numbers not finite, opacity
///         outside [0, 1], a wrong count of triangle colors, a cone's axis that is not unit, its
///         half angle outside [0, pi/2)
DrawList make_draw_list(const Scene& scene);

/// Triangles in an order, and runs of them with one texture.
struct SortedTriangles {
  std::vector<uint32_t> indices;
  std::vector<TexturedRun> runs;  ///< all that have no texture can be drawn together
};

/// Those of `clear`, the farthest from the eye first; scene units.
SortedTriangles back_to_front(const DrawList& list, const Eye& eye);

}  // namespace clench
