// A binary tree of oriented boxes over the triangles of a mesh, one triangle a leaf, and the walk
// over two such trees that every pair query shares. For the queries of this module only.
// source  Gottschalk, Lin & Manocha (1996), OBBTree
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/triangle.h"
#include "math/pose.h"

namespace clench {

class Shape;

struct OrientedBox {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns, orthonormal
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d half = Eigen::Vector3d::Zero();      ///< half extents along the axes [m]

  /// distance of p from the box, squared; 0 inside [m^2]
  double squared_distance(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d local = axes.transpose() * (p - centre);
    return (local.cwiseAbs() - half).cwiseMax(0).squaredNorm();
  }
};

/// What rounding may add to a gap between boxes within the bounds, or at p or as far away [m]
double box_slack(const Bounds& bounds, const Eigen::Vector3d& p);

/// How near two things must be to matter.
struct Reach {
  double distance;  ///< [m]
  /// unit, from a to b where they are near; or zero
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};

/// A lower bound of the distance between two boxes: by the known direction, which parts most of
/// what is near, and if that leaves them within reach, by their own axes. What rounding may add,
/// slack, is taken off [m].
double gap(const OrientedBox& a, const OrientedBox& b, const Reach& reach, double slack);

class Tree {
 public:
  struct Node {
    OrientedBox box;
    double size = 0;    ///< half the diagonal of the box [m]
    int right = -1;     ///< second child; the first one follows its parent
    int triangle = -1;  ///< of a leaf

    bool leaf() const { return triangle >= 0; }
  };

  explicit Tree(const Mesh& mesh);
  const Node& node(int i) const { return nodes_[i]; }

 private:
  std::vector<Node> nodes_;  // parents before children, root first
};

/// Shape b in the frame of shape a. All pair queries move corners by the same arithmetic.
class Placement {
 public:
  /// throws Error when the pose is not one
  Placement(const Shape& a, const Shape& b, const Pose& X_AB);

  Corners corners_a(int triangle) const;
  Corners corners_b(int triangle) const;
  Eigen::Vector3d to_a(const Eigen::Vector3d& p_B) const { return rotation_ * p_B + position_; }
  Eigen::Vector3d to_b(const Eigen::Vector3d& p_A) const {
    return rotation_.transpose() * (p_A - position_);
  }
  OrientedBox to_a(const OrientedBox& box) const {
    return {rotation_ * box.axes, to_a(box.centre), box.half};
  }
  /// do the triangles lie farther apart than reach along its direction?
  bool beyond(const Corners& a, const Corners& b, const Reach& reach) const {
    const Eigen::Vector3d& n = reach.along;
    return std::min({n.dot(b[0]), n.dot(b[1]), n.dot(b[2])}) -
               std::max({n.dot(a[0]), n.dot(a[1]), n.dot(a[2])}) - slack_ >
           reach.distance;
  }
  /// Calls visit(triangle_a, triangle_b) for all pairs that may be as near as `reach`, near ones
  /// first; visit may lower `reach`, and ends the walk by returning true.
  template <class Visit>
  bool for_near_pairs(const Reach& reach, Visit&& visit) const;

 private:
  template <class Visit>
  bool walk(int node_a, int node_b, const OrientedBox& box_b, const Reach& reach,
            Visit& visit) const;

  const Mesh &mesh_a_, &mesh_b_;
  const Tree &tree_a_, &tree_b_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d position_;
  double slack_;
};

template <class Visit>
bool Placement::for_near_pairs(const Reach& reach, Visit&& visit) const {
  const OrientedBox root = to_a(tree_b_.node(0).box);
  if (gap(tree_a_.node(0).box, root, reach, slack_) > reach.distance) return false;
  return walk(0, 0, root, reach, visit);
}

template <class Visit>
bool Placement::walk(int node_a, int node_b, const OrientedBox& box_b, const Reach& reach,
                     Visit& visit) const {
  const Tree::Node &a = tree_a_.node(node_a), &b = tree_b_.node(node_b);
  if (a.leaf() && b.leaf()) return visit(a.triangle, b.triangle);

  // open the larger box, go into its nearer half first
  if (b.leaf() || (!a.leaf() && a.size >= b.size)) {
    int first = node_a + 1, second = a.right;
    double near = gap(tree_a_.node(first).box, box_b, reach, slack_);
    double far = gap(tree_a_.node(second).box, box_b, reach, slack_);
    if (far < near) std::swap(near, far), std::swap(first, second);
    return (near <= reach.distance && walk(first, node_b, box_b, reach, visit)) ||
           (far <= reach.distance && walk(second, node_b, box_b, reach, visit));
  }
  int first = node_b + 1, second = b.right;
  OrientedBox box_first = to_a(tree_b_.node(first).box),
              box_second = to_a(tree_b_.node(second).box);
  double near = gap(a.box, box_first, reach, slack_);
  double far = gap(a.box, box_second, reach, slack_);
  if (far < near) std::swap(near, far), std::swap(first, second), std::swap(box_first, box_second);
  return (near <= reach.distance && walk(node_a, first, box_first, reach, visit)) ||
         (far <= reach.distance && walk(node_a, second, box_second, reach, visit));
}

}  // namespace clench
