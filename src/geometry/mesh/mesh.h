// Triangle meshes as values: positions, triangles, and quantities derived from them.
#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "clench/base/progress.h"

namespace clench {

using Triangle = std::array<int, 3>;  ///< vertex indices, counter-clockwise from outside

/// Bound on coordinates of vertices, and of positions in a world; a thousand times beyond it
/// queries lose digits [m].
inline constexpr double largest_coordinate = 1e9;

/// Axis-aligned bounds; empty when low > high.
struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;

  void add(const Eigen::Vector3d& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
  bool holds(const Eigen::Vector3d& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
  bool empty() const { return (low.array() > high.array()).any(); }
  Eigen::Vector3d center() const { return 0.5 * (low + high); }
  Eigen::Vector3d size() const { return high - low; }
};

/// Vertices [m] and triangles. Plain data: fill it, then pass it to Shape::make.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;

  std::array<Eigen::Vector3d, 3> corners(int triangle) const {
    const auto& t = triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
  Bounds bounds() const;
  double area() const;  ///< [m^2]
};

/// Defects of a mesh, counted. A closed mesh has no open or tangled edge.
struct MeshFaults {
  int degenerate_triangles = 0;  ///< without area, or with a repeated vertex
  int duplicate_triangles = 0;   ///< same three vertices as an earlier one
  int open_edges = 0;            ///< edges of one triangle only
  /// edges of more than two triangles, or traversed twice in the same direction
  int tangled_edges = 0;
  int unused_vertices = 0;

  bool closed() const { return open_edges == 0 && tangled_edges == 0; }
  bool none() const {
    return closed() && degenerate_triangles + duplicate_triangles + unused_vertices == 0;
  }
  std::string describe() const;  ///< "2 open edges, 1 degenerate triangle", or "no faults"
};

/// Has the triangle a repeated vertex, or no more area than the rounding of three collinear points?
bool without_area(const Mesh& mesh, int triangle);

/// Do all vertices lie on or behind the plane of every triangle, up to rounding? False also for
/// meshes for which the test would take long: those with more than about 700 triangles.
bool is_convex(const Mesh& mesh);

/// throws Stopped
MeshFaults find_faults(const Mesh& mesh, const Progress& progress = {});

/// Merges vertices nearer than tolerance [m] (only equal ones if 0); triangles keep their order;
/// those left with a repeated vertex are dropped, and counted in `dropped`.
Mesh weld(const Mesh& mesh, double tolerance = 0, int* dropped = nullptr,
          const Progress& progress = {});

/// Positions finite, indices in range, at least one triangle.
/// throws  Error that names the offending vertex or triangle
void check_mesh(const Mesh& mesh, const std::string& subject);

}  // namespace clench
