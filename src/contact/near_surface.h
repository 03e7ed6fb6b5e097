// The near triangles of one shape, and which of them share a corner or an edge.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "clench/contact/feature.h"
#include "clench/geometry/mesh/mesh.h"
#include "clench/geometry/query/triangle.h"
#include "clench/math/pose.h"

namespace clench {

/// Corners and edges are numbered by position, so that adjacent triangles are found even if the
/// mesh repeats its vertices. A slot is 3 * triangle + corner; edge k runs from corner k to k + 1.
class NearSurface {
 public:
  /// triangles  indices into the mesh, which must outlive this object, ascending; `X` transforms
  ///            the corners
  NearSurface(const Mesh& mesh, std::vector<int> triangles, const Pose& X);

  int find(int mesh_triangle) const;  ///< its number among the near triangles
  const Corners& corners(int triangle) const { return corners_[triangle]; }
  int corner(int triangle, int k) const { return by_corner_.of[3 * triangle + k]; }
  int edge(int triangle, int k) const { return by_edge_.of[3 * triangle + k]; }
  int corner_count() const { return static_cast<int>(by_corner_.start.size()) - 1; }
  int edge_count() const { return static_cast<int>(by_edge_.start.size()) - 1; }
  /// slots at a corner or an edge, ascending
  std::span<const int> at_corner(int corner) const { return by_corner_.members(corner); }
  std::span<const int> at_edge(int edge) const { return by_edge_.members(edge); }

  /// Slots of the triangles around p, a point of `triangle`: those at its corner or edge; empty
  /// inside the face.
  std::span<const int> around(int triangle, const Eigen::Vector3d& p) const;

  /// The feature of the mesh on which a point of `triangle` lies: the lowest-dimensional one that
  /// contains it.
  Feature feature(int triangle, const Eigen::Vector3d& p) const;
  Feature vertex_feature(int corner) const;
  Feature edge_feature(int edge) const;

  /// Is p the point of these triangles that is farthest along `direction` (unit)? A slope of 1/30
  /// is tolerated.
  ///
  /// reach     largest distance of the triangles considered, > 0 [m]
  /// rounding  of coordinates [m]
  bool is_summit(std::span<const int> slots, const Eigen::Vector3d& p,
                 const Eigen::Vector3d& direction, double reach, double rounding) const;

 private:
  struct Groups {
    std::vector<int> of;     // slot -> number
    std::vector<int> start;  // number -> first member, and one past the last
    std::vector<int> order;  // slots by number
    std::span<const int> members(int number) const {
      return {order.data() + start[number], order.data() + start[number + 1]};
    }
  };
  static Groups group(std::vector<int> of, int count);
  // position of a point on the border of its triangle: corner k, edge k, or neither
  enum class Border { corner, edge, none };
  std::pair<Border, int> border(int triangle, const Eigen::Vector3d& p) const;

  const Mesh* mesh_;
  std::vector<int> triangles_;
  std::vector<Corners> corners_;
  Groups by_corner_, by_edge_;
};

}  // namespace clench
