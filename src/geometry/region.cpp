#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/queries.h"
#include "geometry/tree.h"

namespace clench {

std::vector<int> region(const Shape& shape, const Eigen::Vector3d& p, double radius) {
  if (!p.allFinite() || std::isnan(radius))
    fail("region: point and radius must be numbers [m], got ({}, {}, {}), {}", p.x(), p.y(), p.z(),
         radius);
  std::vector<int> out;
  const Tree& tree = shape.tree();
  const double reach = radius + box_slack(shape.bounds(), p);
  std::vector<int> waiting = {0};
  while (!waiting.empty()) {
    const int at = waiting.back();
    const Tree::Node& node = tree.node(at);
    waiting.pop_back();
    if (std::sqrt(node.box.squared_distance(p)) > reach) continue;
    if (!node.leaf()) {
      waiting.insert(waiting.end(), {node.right, at + 1});
    } else if (point_triangle(p, shape.mesh().corners(node.triangle)).distance < radius) {
      out.push_back(node.triangle);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace clench
