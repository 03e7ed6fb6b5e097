#include "clench/geometry/mesh/parts.h"

#include <array>

#include "clench/base/watched.h"

namespace clench {

DisjointSets connected_vertices(const Mesh& mesh) {
  DisjointSets parts(mesh.vertices.size());
  check_stop();
  for (const Triangle& t : mesh.triangles) parts.join(t[0], t[1]), parts.join(t[0], t[2]);

  std::vector<int> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) {
    const Eigen::Vector3d& p = mesh.vertices[v];
    return std::array<double, 3>{p.x(), p.y(), p.z()};
  };
  StopCheck check(1 << 14);
  std::sort(order.begin(), order.end(), [&](int u, int v) {
    check();
    return key(u) < key(v);
  });
  for (size_t i = 1; i < order.size(); ++i)
    if (mesh.vertices[order[i - 1]] == mesh.vertices[order[i]]) parts.join(order[i - 1], order[i]);
  return parts;
}

}  // namespace clench
