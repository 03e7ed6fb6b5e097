#include "clench/render/mesh/outward.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace clench {

bool faces_outward(const Shape& shape) {
  if (!shape.has_volume()) return false;
  const auto& vertices = shape.mesh().vertices;
  // parts by union-find, with vertices at one place as one
  std::vector<int> order(vertices.size()), leader(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  const auto before = [&](int a, int b) {
    return std::lexicographical_compare(vertices[a].data(), vertices[a].data() + 3,
                                        vertices[b].data(), vertices[b].data() + 3);
  };
  std::ranges::sort(order, before);
  for (size_t i = 1; i < order.size(); ++i)
    if (vertices[order[i]] == vertices[order[i - 1]]) leader[find(order[i])] = find(order[i - 1]);
  for (const Triangle& t : shape.mesh().triangles)
    for (const int v : {t[1], t[2]}) leader[find(v)] = find(t[0]);
  std::vector<double> volumes(vertices.size(), 0);
  for (const Triangle& t : shape.mesh().triangles) {
    const auto at = [&](int k) -> Eigen::Vector3d { return vertices[t[k]] - shape.centre(); };
    volumes[find(t[0])] += at(0).dot(at(1).cross(at(2)));
  }
  // a part without triangles has none
  for (const Triangle& t : shape.mesh().triangles)
    if (!(volumes[find(t[0])] > 0)) return false;
  return true;
}

bool hides_inside(const Eigen::Vector3d& centre, double radius, const Eye& eye) {
  return eye.ortho_height > 0 || (centre - eye.eye).norm() > 1.5 * radius + 0.03;
}

}  // namespace clench
