// A tree of oriented boxes, eight children per node, over the triangles of a mesh: single
// precision, rounded outward. Boxes and corners are about the tree's center. Includes no Eigen, as
// lanes.h does not.
// source  Gottschalk, Lin & Manocha (1996), OBBTree; Dammertz, Hanika & Keller (2008), wide trees
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "clench/base/function_ref.h"
#include "clench/geometry/tree/bounding_polytope.h"

namespace clench {

struct Mesh;
class Progress;
struct ExposedSurface;  // of query/exposed

/// Eight boxes side by side: the children of a node.
struct alignas(32) BoxBundle {
  float axes[9][8];  ///< component m of axis k of box i at [3 k + m][i]; unit up to rounding
  float center[3][8];
  float half[3][8];  ///< half extents along the axes, rounded up
  float size[8];     ///< half the diagonal
  int32_t child[8];  ///< leaf: 2 * index + 1, node: 2 * index; -1: none
};

/// Up to eight triangles: a leaf. Unused lanes repeat the first.
struct alignas(32) TriangleBundle {
  float corners[9][8];  ///< coordinate m of corner k of triangle i at [3 k + m][i], rounded
  int32_t triangle[8];  ///< in the mesh; -1: none
};

class Tree {
 public:
  /// at least one triangle; coordinates finite   throws Stopped
  Tree(const Mesh& mesh, const Progress& progress);

  /// index 0 contains a single box, that of the complete mesh
  const BoxBundle& boxes(int i) const { return boxes_[i]; }
  const TriangleBundle& leaf(int i) const { return leaves_[i]; }
  const BoundingPolytope& bounding_polytope() const { return bounding_polytope_; }
  const double* center() const { return center_; }  ///< in the mesh's frame [m]
  double radius() const { return radius_; }         ///< no vertex is farther from the center [m]
  std::size_t bytes() const;

  using ExposedPtr = std::shared_ptr<const ExposedSurface>;
  /// The boundary of a union, which `find` computes on first use. Any thread may call it.
  /// throws as find, and then keeps none
  ExposedPtr exposed(FunctionRef<ExposedPtr()> find) const {
    const std::lock_guard lock(exposing_);
    if (!exposed_) exposed_ = find();
    return exposed_;
  }

 private:
  friend class TreeBuilder;
  std::vector<BoxBundle> boxes_;
  std::vector<TriangleBundle> leaves_;
  BoundingPolytope bounding_polytope_;
  double center_[3] = {};
  double radius_ = 0;
  mutable std::mutex exposing_;
  mutable ExposedPtr exposed_;
};

/// no path from the root passes more bundles
inline constexpr int deepest_tree = 70;

}  // namespace clench
