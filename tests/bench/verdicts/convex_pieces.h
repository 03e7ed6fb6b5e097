// Convex pieces of meshes, for engines that only collide convex shapes.
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

/// The corners of the hull of each connected part of a mesh: for robots' links, whose shapes are
/// several boxes, cylinders or meshes.
std::vector<Points> hulls_of_parts(const Surface& surface);

/// The corners of convex pieces that together approximate the solid. Planes across its axes divide
/// it one by one at the largest reduction of the hulls' total volume, while that is more than
/// `gain` of the whole.
std::vector<Points> convex_pieces(const Surface& surface, int max_count = 32, double gain = 0.002);

/// Convex pieces of a grasped object: those of convex_pieces; if their volume exceeds that of the
/// solid by more than a tenth, as between the walls of a vessel, hulls of the parts of its surface
/// in cells of 8 mm, with a skin of 0.4 mm.
std::vector<Points> pieces_of_object(const Surface& surface);

}  // namespace clench::bench
