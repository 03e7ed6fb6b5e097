// Convex pieces of meshes, for engines that collide nothing else.
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace clench::bench {

struct Surface {
  std::vector<Eigen::Vector3d> vertices;  // [m]
  std::vector<std::array<int, 3>> triangles;
};

using Points = std::vector<Eigen::Vector3d>;

/// The corners of the hull of each connected part of a mesh: of robots' links, whose shapes are
/// several boxes, cylinders or meshes.
std::vector<Points> hulls_of_parts(const Surface& surface);

/// The corners of convex pieces that together are nearly the solid: it is cut by planes across its
/// axes, always where the hulls of all pieces lose the largest volume, while that is more than
/// `gain` of the whole.
std::vector<Points> convex_pieces(const Surface& surface, int max_count = 32, double gain = 0.002);

/// Convex pieces of an object that is grasped: as convex_pieces, or, where these fill more than a
/// tenth beyond the solid, as between the walls of a vessel, hulls of the parts of its surface in
/// cells of 8 mm, with a skin of 0.4 mm.
std::vector<Points> pieces_of_object(const Surface& surface);

}  // namespace clench::bench
