#include "bench/verdicts/convex_pieces.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "clench/geometry/mesh/hull.h"

namespace clench::bench {

namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

struct Piece {
  std::vector<Triangle> triangles;
  double volume = 0;  // of the hull
};

struct Cut {
  double gain = 0;
  Piece low, high;
};

Hull hull_of(const std::vector<Triangle>& triangles) {
  Eigen::MatrixXd points(3, 3 * triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) points.col(Eigen::Index(3 * t + k)) = triangles[t][k];
  if (points.cols() < 4) return {};
  return convex_hull(points);
}

// of many corners, keeps those farthest along directions spread evenly over the sphere: accurate to
// a thousandth of the size, and few enough for engines that visit all corners for each contact
Points thinned(const Points& points) {
  constexpr int count = 300;
  if (int(points.size()) <= count / 2) return points;
  std::set<size_t> kept;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, turn = i * 2.399963229728653,
                 r = std::sqrt(1 - z * z);
    const Eigen::Vector3d direction(r * std::cos(turn), r * std::sin(turn), z);
    size_t best = 0;
    for (size_t p = 1; p < points.size(); ++p)
      if (points[p].dot(direction) > points[best].dot(direction)) best = p;
    kept.insert(best);
  }
  Points out;
  for (const size_t p : kept) out.push_back(points[p]);
  return out;
}

Points corners(const std::vector<Triangle>& triangles) {
  const Hull hull = hull_of(triangles);
  std::set<std::array<double, 3>> found;
  for (const auto& facet : hull.facets)
    for (int i : facet) {
      const Eigen::Vector3d& p = triangles[i / 3][i % 3];
      found.insert({p.x(), p.y(), p.z()});
    }
  Points out;
  for (const auto& p : found) out.emplace_back(p[0], p[1], p[2]);
  return thinned(out);
}

// the part of a triangle with side * (x[axis] - at) >= 0
void clip(const Triangle& triangle, int axis, double at, double side, std::vector<Triangle>& out) {
  Points polygon;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d &a = triangle[k], &b = triangle[(k + 1) % 3];
    const double da = side * (a[axis] - at), db = side * (b[axis] - at);
    if (da >= 0) polygon.push_back(a);
    if (da * db < 0) polygon.push_back(a + (b - a) * (da / (da - db)));
  }
  for (size_t k = 2; k < polygon.size(); ++k)
    out.push_back({polygon[0], polygon[k - 1], polygon[k]});
}

Piece part_of(const Piece& piece, int axis, double at, double side) {
  Piece part;
  for (const Triangle& triangle : piece.triangles) clip(triangle, axis, at, side, part.triangles);
  part.volume = hull_of(part.triangles).volume;
  return part;
}

Cut best_cut(const Piece& piece) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : piece.triangles)
    for (const auto& p : t) box.extend(p);
  Cut best;
  const int tries = 7;
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 1; k <= tries; ++k) {
      const double at = box.min()[axis] + box.sizes()[axis] * k / (tries + 1);
      Piece low = part_of(piece, axis, at, -1), high = part_of(piece, axis, at, 1);
      const double gain = piece.volume - low.volume - high.volume;
      if (gain > best.gain) best = {gain, std::move(low), std::move(high)};
    }
  }
  return best;
}

}  // namespace

std::vector<Points> hulls_of_parts(const Surface& surface) {
  // corners with equal coordinates are merged
  std::map<std::array<double, 3>, int> numbers;
  std::vector<int> place(surface.vertices.size()), group;
  for (size_t v = 0; v < place.size(); ++v) {
    const auto& p = surface.vertices[v];
    place[v] = numbers.try_emplace({p.x(), p.y(), p.z()}, int(numbers.size())).first->second;
  }
  group.resize(numbers.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int v) {
    while (group[v] != v) v = group[v] = group[group[v]];
    return v;
  };
  for (const auto& t : surface.triangles)
    for (int k = 1; k < 3; ++k) group[root(place[t[k]])] = root(place[t[0]]);
  std::map<int, std::vector<Triangle>> parts;
  for (const auto& t : surface.triangles)
    parts[root(place[t[0]])].push_back(
        {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
  std::vector<Points> out;
  for (const auto& [r, triangles] : parts) {
    out.push_back(corners(triangles));
    if (out.back().size() < 4) out.pop_back();
  }
  return out;
}

std::vector<Points> convex_pieces(const Surface& surface, int max_count, double gain) {
  Piece whole;
  for (const auto& t : surface.triangles)
    whole.triangles.push_back(
        {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
  whole.volume = hull_of(whole.triangles).volume;
  const double enough = gain * whole.volume;
  std::vector<Piece> pieces{std::move(whole)};
  std::vector<Cut> cuts{best_cut(pieces[0])};
  while (int(pieces.size()) < max_count) {
    size_t best = 0;
    for (size_t i = 1; i < cuts.size(); ++i)
      if (cuts[i].gain > cuts[best].gain) best = i;
    if (cuts[best].gain < enough) break;
    Cut cut = std::move(cuts[best]);
    pieces[best] = std::move(cut.low);
    pieces.push_back(std::move(cut.high));
    cuts[best] = best_cut(pieces[best]);
    cuts.push_back(best_cut(pieces.back()));
  }
  std::vector<Points> out;
  for (const Piece& piece : pieces) {
    out.push_back(corners(piece.triangles));
    if (out.back().size() < 4) out.pop_back();
  }
  return out;
}

namespace {

constexpr double cell_size = 0.008;    // [m]
constexpr double skin_depth = 0.0004;  // [m]

// corners of triangles, and of the same triangles moved inwards
Points skin_of(const std::vector<Triangle>& triangles) {
  Points points;
  for (const Triangle& t : triangles) {
    const Eigen::Vector3d area = (t[1] - t[0]).cross(t[2] - t[0]);
    if (area.norm() < 1e-12) continue;
    const Eigen::Vector3d inwards = -skin_depth * area.normalized();
    for (const auto& p : t) points.push_back(p), points.push_back(p + inwards);
  }
  return points;
}

void add_cells(const std::vector<Triangle>& triangles, std::vector<Points>& out) {
  Eigen::AlignedBox3d box;
  for (const Triangle& t : triangles)
    for (const auto& p : t) box.extend(p);
  int axis = 0;
  if (triangles.empty()) return;
  if (box.sizes().maxCoeff(&axis) > cell_size) {
    for (const double side : {-1.0, 1.0}) {
      std::vector<Triangle> part;
      for (const Triangle& t : triangles) clip(t, axis, box.center()[axis], side, part);
      add_cells(part, out);
    }
    return;
  }
  Eigen::MatrixXd points(3, 0);
  const Points skin = skin_of(triangles);
  points.resize(3, Eigen::Index(skin.size()));
  for (size_t i = 0; i < skin.size(); ++i) points.col(Eigen::Index(i)) = skin[i];
  if (points.cols() < 4) return;
  const Hull hull = convex_hull(points);
  std::set<int> used;
  for (const auto& facet : hull.facets) used.insert(facet.begin(), facet.end());
  Points corners;
  for (const int i : used) corners.push_back(skin[size_t(i)]);
  if (corners.size() >= 4) out.push_back(thinned(corners));
}

double volume_of(const Surface& surface) {
  double volume = 0;
  for (const auto& t : surface.triangles)
    volume += surface.vertices[t[0]].dot(surface.vertices[t[1]].cross(surface.vertices[t[2]])) / 6;
  return volume;
}

}  // namespace

std::vector<Points> pieces_of_object(const Surface& surface) {
  constexpr double filled = 1.1;
  std::vector<Points> pieces = convex_pieces(surface);
  double volume = 0;
  for (const Points& piece : pieces) {
    Eigen::MatrixXd points(3, Eigen::Index(piece.size()));
    for (size_t i = 0; i < piece.size(); ++i) points.col(Eigen::Index(i)) = piece[i];
    volume += convex_hull(points).volume;
  }
  if (volume <= filled * volume_of(surface)) return pieces;
  std::vector<Triangle> triangles;
  for (const auto& t : surface.triangles)
    triangles.push_back({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
  std::vector<Points> cells;
  add_cells(triangles, cells);
  return cells;
}

}  // namespace clench::bench
