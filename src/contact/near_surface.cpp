#include "clench/contact/near_surface.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace clench {

using Eigen::Vector3d;

static constexpr double max_slope = 1.0 / 30;  // slope tolerated by is_summit
// fraction of a triangle's size: points nearer to an edge count as on the edge
static constexpr double on_boundary = 1e-9;

// members of the groups 0 to count - 1, in the order of the slots
NearSurface::Groups NearSurface::group(std::vector<int> of, int count) {
  Groups groups;
  groups.start.assign(count + 1, 0);
  for (const int number : of) ++groups.start[number + 1];
  std::partial_sum(groups.start.begin(), groups.start.end(), groups.start.begin());
  groups.order.resize(of.size());
  std::vector<int> next(groups.start.begin(), groups.start.end() - 1);
  for (int slot = 0; slot < static_cast<int>(of.size()); ++slot)
    groups.order[next[of[slot]]++] = slot;
  groups.of = std::move(of);
  return groups;
}

// Sorted numbers without duplicates, all below `limit`. Large sets are marked in a table.
static std::vector<int> distinct_numbers(const std::vector<int>& numbers, int limit) {
  constexpr size_t many = 8;
  if (many * numbers.size() < static_cast<size_t>(limit)) {
    std::vector<int> out = numbers;
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }
  std::vector<char> used(limit, 0);
  for (const int number : numbers) used[number] = 1;
  std::vector<int> out;
  for (int number = 0; number < limit; ++number)
    if (used[number]) out.push_back(number);
  return out;
}

// Vertices by slot -> numbers of their positions, in order of appearance. Few vertices are compared
// by position, those that differ by index.
static int number_positions(const std::vector<Vector3d>& vertices, std::vector<int>& slots) {
  const std::vector<int> distinct = distinct_numbers(slots, static_cast<int>(vertices.size()));
  std::vector<int> order(distinct.size()), number(distinct.size());
  std::iota(order.begin(), order.end(), 0);
  const auto less = [&](int i, int j) {
    const Vector3d &p = vertices[distinct[i]], &q = vertices[distinct[j]];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::sort(order.begin(), order.end(), less);
  int count = 0;
  for (size_t k = 0; k < order.size(); ++k) {
    count += k == 0 || less(order[k - 1], order[k]);
    number[order[k]] = count - 1;
  }
  for (int& slot : slots)
    slot = number[std::lower_bound(distinct.begin(), distinct.end(), slot) - distinct.begin()];
  return count;
}

NearSurface::NearSurface(const Mesh& mesh, std::vector<int> triangles, const Pose& X)
    : mesh_(&mesh), triangles_(std::move(triangles)) {
  const int slots = 3 * static_cast<int>(triangles_.size());
  std::vector<int> corners(slots);
  for (int slot = 0; slot < slots; ++slot)
    corners[slot] = mesh.triangles[triangles_[slot / 3]][slot % 3];
  const auto position = [&](int slot) -> const Vector3d& {
    return mesh.vertices[mesh.triangles[triangles_[slot / 3]][slot % 3]];
  };
  const int corner_count = number_positions(mesh.vertices, corners);
  by_corner_ = group(std::move(corners), corner_count);

  // edges in the order of both ends
  std::vector<std::pair<int64_t, int>> ends(slots);
  for (int slot = 0; slot < slots; ++slot) {
    const int next = slot - slot % 3 + (slot + 1) % 3;
    const auto [low, high] = std::minmax({by_corner_.of[slot], by_corner_.of[next]});
    ends[slot] = {(static_cast<int64_t>(low) << 32) | high, slot};
  }
  std::sort(ends.begin(), ends.end());
  std::vector<int> edges(slots);
  int edge_count = 0;
  for (int k = 0; k < slots; ++k) {
    edge_count += k == 0 || ends[k - 1].first != ends[k].first;
    edges[ends[k].second] = edge_count - 1;
  }
  by_edge_ = group(std::move(edges), edge_count);

  const Eigen::Matrix3d turn = X.matrix();
  corners_.resize(triangles_.size());
  for (int slot = 0; slot < slots; ++slot)
    corners_[slot / 3][slot % 3] = turn * position(slot) + X.position;
}

int NearSurface::find(int mesh_triangle) const {
  return static_cast<int>(std::lower_bound(triangles_.begin(), triangles_.end(), mesh_triangle) -
                          triangles_.begin());
}

std::pair<NearSurface::Border, int> NearSurface::border(int triangle, const Vector3d& p) const {
  const Corners& c = corners_[triangle];
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max(size, (c[(k + 1) % 3] - c[k]).norm());
  const double near = on_boundary * size;
  for (int k = 0; k < 3; ++k)
    if ((p - c[k]).norm() <= near) return {Border::corner, k};
  for (int k = 0; k < 3; ++k) {
    const Vector3d along = c[(k + 1) % 3] - c[k];
    if (along.cross(p - c[k]).norm() <= near * along.norm()) return {Border::edge, k};
  }
  return {Border::none, 0};
}

std::span<const int> NearSurface::around(int triangle, const Vector3d& p) const {
  const auto [where, k] = border(triangle, p);
  if (where == Border::corner) return at_corner(corner(triangle, k));
  if (where == Border::edge) return at_edge(edge(triangle, k));
  return {};
}

Feature NearSurface::vertex_feature(int corner) const {
  int lowest = std::numeric_limits<int>::max();
  for (const int slot : at_corner(corner))
    lowest = std::min(lowest, mesh_->triangles[triangles_[slot / 3]][slot % 3]);
  return {Feature::vertex, lowest, -1};
}

Feature NearSurface::edge_feature(int edge) const {
  const int slot = at_edge(edge)[0];
  const int from = vertex_feature(corner(slot / 3, slot % 3)).first;
  const int to = vertex_feature(corner(slot / 3, (slot % 3 + 1) % 3)).first;
  return {Feature::edge, std::min(from, to), std::max(from, to)};
}

Feature NearSurface::feature(int triangle, const Vector3d& p) const {
  const auto [where, k] = border(triangle, p);
  if (where == Border::corner) return vertex_feature(corner(triangle, k));
  if (where == Border::edge) return edge_feature(edge(triangle, k));
  return {Feature::triangle, triangles_[triangle], -1};
}

bool NearSurface::is_summit(std::span<const int> slots, const Vector3d& p,
                            const Vector3d& direction, double reach, double rounding) const {
  for (const int slot : slots) {
    // a step off the surface, short enough to measure the slope and to stay on the triangle
    const Corners& c = corners_[slot / 3];
    double step = reach;
    for (int k = 0; k < 3; ++k) {
      const double length = (c[(k + 1) % 3] - c[k]).norm();
      if (length > 0) step = std::min(step, length);
    }
    const double shift = (point_triangle(p + step * direction, c).q - p).norm();
    if (shift > max_slope * step + rounding) return false;
  }
  return true;
}

}  // namespace clench
