#include "clench/geometry/query/bounding_boxes.h"

#include "clench/base/error.h"
#include "clench/geometry/tree/tree.h"

namespace clench {

static OrientedBox box_at(const Tree& tree, const BoxBundle& bundle, int i) {
  const auto axis = [&](int k) {
    return Eigen::Vector3d(bundle.axes[3 * k][i], bundle.axes[3 * k + 1][i],
                           bundle.axes[3 * k + 2][i]);
  };
  Eigen::Matrix3d axes;
  axes.col(0) = axis(0).normalized();
  axes.col(1) = (axis(1) - axis(1).dot(axes.col(0)) * axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  const Eigen::Vector3d center(bundle.center[0][i], bundle.center[1][i], bundle.center[2][i]);
  return {{Eigen::Quaterniond(axes), Eigen::Vector3d::Map(tree.center()) + center},
          {bundle.half[0][i], bundle.half[1][i], bundle.half[2][i]}};
}

static void collect(const Tree& tree, int index, int depth, std::vector<OrientedBox>& out) {
  const BoxBundle& bundle = tree.boxes(index);
  for (int i = 0; i < 8; ++i) {
    const int child = bundle.child[i];
    if (child < 0) continue;
    const bool is_leaf = child % 2 == 1;
    if (depth == 0 || is_leaf)
      out.push_back(box_at(tree, bundle, i));
    else
      collect(tree, child / 2, depth - 1, out);
  }
}

std::vector<OrientedBox> bounding_boxes(const Shape& shape, int depth, const Progress& progress) {
  if (depth < 0 || depth > max_box_depth)
    fail("bounding boxes: depth: expected 0 to {}, got {}", max_box_depth, depth);
  std::vector<OrientedBox> out;
  collect(shape.tree(progress), 0, depth, out);
  return out;
}

}  // namespace clench
