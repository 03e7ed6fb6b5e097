#include "clench/render/mesh/outward.h"

#include <vector>

#include "clench/geometry/mesh/parts.h"

namespace clench {

bool faces_outward(const Shape& shape) {
  if (!shape.has_volume()) return false;
  const auto& vertices = shape.mesh().vertices;
  DisjointSets parts = connected_vertices(shape.mesh());
  std::vector<double> volumes(vertices.size(), 0);
  for (const Triangle& t : shape.mesh().triangles) {
    const auto at = [&](int k) -> Eigen::Vector3d { return vertices[t[k]] - shape.center(); };
    volumes[parts.find(t[0])] += at(0).dot(at(1).cross(at(2)));
  }
  // a part without triangles has no volume
  for (const Triangle& t : shape.mesh().triangles)
    if (!(volumes[parts.find(t[0])] > 0)) return false;
  return true;
}

bool hides_inside(const Eigen::Vector3d& center, double radius, const Eye& eye) {
  return eye.ortho_height > 0 || (center - eye.eye).norm() > 1.5 * radius + 0.03;
}

}  // namespace clench
