#include "contact/near_surface.h"

#include <algorithm>
#include <numeric>

namespace clench {

using Eigen::Vector3d;

static constexpr double most_slope = 1.0 / 30;  // forgiven by is_summit
static constexpr double on_boundary = 1e-9;     // of a triangle's size: nearer is on its edge

// equal slots, those of which neither is less, get one number
template <class Less>
NearSurface::Groups NearSurface::group(int count, Less less) {
  Groups groups;
  groups.of.resize(count);
  groups.order.resize(count);
  std::iota(groups.order.begin(), groups.order.end(), 0);
  std::sort(groups.order.begin(), groups.order.end(),
            [&](int i, int j) { return less(i, j) || (!less(j, i) && i < j); });
  for (int k = 0; k < count; ++k) {
    if (k == 0 || less(groups.order[k - 1], groups.order[k])) groups.start.push_back(k);
    groups.of[groups.order[k]] = static_cast<int>(groups.start.size()) - 1;
  }
  groups.start.push_back(count);
  return groups;
}

NearSurface::NearSurface(const Mesh& mesh, std::vector<int> triangles, const Pose& X)
    : triangles_(std::move(triangles)) {
  const int slots = 3 * static_cast<int>(triangles_.size());
  const auto position = [&](int slot) -> const Vector3d& {
    return mesh.vertices[mesh.triangles[triangles_[slot / 3]][slot % 3]];
  };
  by_corner_ = group(slots, [&](int i, int j) {
    const Vector3d &p = position(i), &q = position(j);
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  const auto ends = [&](int slot) {
    const int next = slot - slot % 3 + (slot + 1) % 3;
    return std::minmax({by_corner_.of[slot], by_corner_.of[next]});
  };
  by_edge_ = group(slots, [&](int i, int j) { return ends(i) < ends(j); });

  const Eigen::Matrix3d turn = X.matrix();
  corners_.resize(triangles_.size());
  for (int slot = 0; slot < slots; ++slot)
    corners_[slot / 3][slot % 3] = turn * position(slot) + X.position;
}

int NearSurface::find(int mesh_triangle) const {
  return static_cast<int>(std::lower_bound(triangles_.begin(), triangles_.end(), mesh_triangle) -
                          triangles_.begin());
}

std::span<const int> NearSurface::around(int triangle, const Vector3d& p) const {
  const Corners& c = corners_[triangle];
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, (c[(k + 1) % 3] - c[k]).norm());
  const double near = on_boundary * size;
  for (int k = 0; k < 3; ++k)
    if ((p - c[k]).norm() <= near) return at_corner(corner(triangle, k));
  for (int k = 0; k < 3; ++k) {
    const Vector3d along = c[(k + 1) % 3] - c[k];
    if (along.cross(p - c[k]).norm() <= near * along.norm()) return at_edge(edge(triangle, k));
  }
  return {};
}

bool NearSurface::is_summit(std::span<const int> slots, const Vector3d& p,
                            const Vector3d& direction, double reach, double rounding) const {
  for (const int slot : slots) {
    // a step off the surface, short enough to see the slope and not the triangle's end
    const Corners& c = corners_[slot / 3];
    double step = reach;
    for (int k = 0; k < 3; ++k) {
      const double length = (c[(k + 1) % 3] - c[k]).norm();
      if (length > 0) step = std::min(step, length);
    }
    const double shift = (point_triangle(p + step * direction, c).q - p).norm();
    if (shift > most_slope * step + rounding) return false;
  }
  return true;
}

}  // namespace clench
