#include "clench/io/mesh/geometry_builder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "clench/base/error.h"
#include "clench/base/hash.h"
#include "clench/geometry/mesh/triangulate.h"

namespace clench {

using Eigen::Vector3d;

namespace {

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// A surface, and for each triangle its index among the collected ones.
struct Surface {
  Mesh mesh;
  std::vector<int> kept;
  MeshFaults faults;
};

/// For each point the first point at the same position.
std::vector<int> first_at_place(const std::vector<Vector3d>& points, const Progress& progress) {
  size_t size = 16;
  while (size < 2 * points.size()) size *= 2;
  std::vector<int> table(size, -1), first(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    Hasher hasher;
    for (const double x : points[i]) hasher.add(x + 0.0);  // makes -0 and 0 equal
    size_t slot = hasher.value() & (size - 1);
    while (table[slot] >= 0 && points[table[slot]] != points[i]) slot = (slot + 1) & (size - 1);
    if (table[slot] < 0) table[slot] = static_cast<int>(i);
    first[i] = table[slot];
    if (i % 1024 == 0) progress.check();
  }
  return first;
}

/// Replaces vertex i by vertex to[i] <= i. Removes triangles that are dropped or have a vertex
/// twice, and unused vertices; the others keep their order.
/// dropped  one per triangle; empty: none
Surface with_vertices_merged(const Surface& from, const std::vector<int>& to,
                             const std::vector<char>& dropped = {}) {
  Surface out;
  for (size_t i = 0; i < from.mesh.triangles.size(); ++i) {
    const Triangle& t = from.mesh.triangles[i];
    const Triangle merged = {to[t[0]], to[t[1]], to[t[2]]};
    if (repeats_a_vertex(merged) || (!dropped.empty() && dropped[i])) continue;
    out.mesh.triangles.push_back(merged);
    out.kept.push_back(from.kept[i]);
  }
  std::vector<int> number(from.mesh.vertices.size(), -1);
  for (const Triangle& t : out.mesh.triangles)
    for (const int v : t) number[v] = 0;
  for (size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(out.mesh.vertices.size());
    out.mesh.vertices.push_back(from.mesh.vertices[v]);
  }
  for (Triangle& t : out.mesh.triangles)
    for (int& v : t) v = number[v];
  return out;
}

Surface without_unused_vertices(const Surface& from, const std::vector<char>& dropped = {}) {
  std::vector<int> same(from.mesh.vertices.size());
  std::iota(same.begin(), same.end(), 0);
  return with_vertices_merged(from, same, dropped);
}

void weld_places(Surface& s, bool always, const Progress& progress) {
  const auto first = first_at_place(s.mesh.vertices, progress);
  bool any = false;
  for (size_t i = 0; i < first.size() && !any; ++i) any = first[i] != static_cast<int>(i);
  if (!any) return;
  Surface welded = with_vertices_merged(s, first);
  if (welded.mesh.triangles.empty()) return;
  progress.check();
  welded.faults = find_faults(welded.mesh, progress);
  if (always || welded.faults.open_edges < s.faults.open_edges) s = std::move(welded);
}

/// Merges points along the seams of round shapes that differ only in their last bits, if that
/// closes edges. The tolerance is a few units in the last place of 32-bit numbers, which many files
/// store.
void weld_seams(Surface& s, const Progress& progress) {
  const Bounds bounds = s.mesh.bounds();
  const double largest =
      std::max(bounds.low.cwiseAbs().maxCoeff(), bounds.high.cwiseAbs().maxCoeff());
  int dropped = 0;
  Mesh joined = weld(s.mesh, 4e-7 * largest, &dropped, progress);
  if (dropped > 0 || joined.vertices.size() == s.mesh.vertices.size()) return;
  const MeshFaults faults = find_faults(joined, progress);
  if (faults.open_edges >= s.faults.open_edges) return;
  s.mesh = std::move(joined);
  s.faults = faults;
}

/// Drops the triangles if that reduces the number of open and tangled edges.
void drop_if_better(Surface& s, const std::vector<char>& dropped, const Progress& progress) {
  Surface rest = without_unused_vertices(s, dropped);
  if (rest.mesh.triangles.empty()) return;
  rest.faults = find_faults(rest.mesh, progress);
  if (rest.faults.open_edges + rest.faults.tangled_edges <
      s.faults.open_edges + s.faults.tangled_edges)
    s = std::move(rest);
}

void drop_flat_triangles(Surface& s, const Progress& progress) {
  std::vector<char> flat(s.mesh.triangles.size());
  for (size_t i = 0; i < flat.size(); ++i) flat[i] = without_area(s.mesh, static_cast<int>(i));
  drop_if_better(s, flat, progress);
}

/// Among triangles over the same vertices, two that face opposite ways enclose nothing: both are
/// dropped. Of the remaining ones only one is kept.
void drop_doubled_triangles(Surface& s, const Progress& progress) {
  const auto& triangles = s.mesh.triangles;
  std::vector<std::pair<Triangle, int>> sorted;  // vertices from the lowest, and the triangle
  std::vector<char> odd(triangles.size()), dropped(triangles.size(), 0);
  for (size_t i = 0; i < triangles.size(); ++i) {
    Triangle t = triangles[i];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    if ((odd[i] = t[1] > t[2])) std::swap(t[1], t[2]);
    sorted.emplace_back(t, static_cast<int>(i));
  }
  std::sort(sorted.begin(), sorted.end());
  for (size_t i = 0; i < sorted.size();) {
    size_t end = i;
    int sum = 0;
    for (; end < sorted.size() && sorted[end].first == sorted[i].first; ++end)
      sum += odd[sorted[end].second] ? -1 : 1;
    bool stays = sum != 0;
    for (; i < end; ++i) {
      const int t = sorted[i].second;
      const bool this_one = stays && (odd[t] != 0) == (sum < 0);
      dropped[t] = !this_one;
      if (this_one) stays = false;
    }
  }
  drop_if_better(s, dropped, progress);
}

}  // namespace

void GeometryBuilder::add(const std::array<Vector3d, 3>& corners, const Eigen::Vector3f& color,
                          float transparency, int line) {
  ++report.triangles_read;
  report.vertices_read += 3;
  if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
  const int first = static_cast<int>(mesh_.vertices.size());
  for (int k = 0; k < 3; ++k) {
    mesh_.vertices.push_back(corners[k]);
    note_far(corners[k], line);
  }
  loose_ = true;
  add_triangle({first, first + 1, first + 2}, color, transparency);
}

// very few vertices are that far out, so that storing their lines is cheap
void GeometryBuilder::note_far(const Vector3d& p, int line) {
  if (line > 0 && p.cwiseAbs().maxCoeff() > largest_coordinate)
    far_lines_[static_cast<int>(mesh_.vertices.size()) - 1] = line;
}

void GeometryBuilder::check_reach(const std::string& subject) const {
  for (const Triangle& t : mesh_.triangles)
    for (const int v : t) {
      const Vector3d& p = mesh_.vertices[v];
      if (p.cwiseAbs().maxCoeff() <= largest_coordinate) continue;
      const auto line = far_lines_.find(v);
      const std::string place =
          line == far_lines_.end() ? subject : fmt::format("{}:{}", subject, line->second);
      fail("{}: vertex {}: expected coordinates within {} m, got ({}, {}, {})", place, v,
           largest_coordinate, p.x(), p.y(), p.z());
    }
}

int GeometryBuilder::add_vertex(const Vector3d& p, int line) {
  if (mesh_.vertices.size() >= max_vertices_)
    fail("expected at most {} vertices{}", max_vertices_, for_its_size());
  if (mesh_.vertices.size() % 1024 == 0) progress.check();
  mesh_.vertices.push_back(p);
  note_far(p, line);
  return static_cast<int>(mesh_.vertices.size()) - 1;
}

void GeometryBuilder::limit_to(size_t file_bytes) {
  max_triangles_ = std::clamp(file_bytes / 4, size_t{400'000}, max_mesh_triangles);
  max_vertices_ = 3 * max_triangles_;
}

std::string GeometryBuilder::for_its_size() const {
  return max_triangles_ < max_mesh_triangles ? " in a file of its size" : "";
}

void GeometryBuilder::add_face(std::span<const int> corners, const Eigen::Vector3f& color,
                               float transparency, const FaceTexture* texture) {
  if (++faces_ > max_mesh_faces) fail("expected at most {} faces", max_mesh_faces);
  if (corners.size() == 3) {
    ++report.triangles_read;
    const Triangle t = {corners[0], corners[1], corners[2]};
    if (!repeats_a_vertex(t)) add_triangle(t, color, transparency, texture);
    return;
  }
  std::vector<Vector3d> points;
  for (const int v : corners) points.push_back(mesh_.vertices[v]);
  for (const Triangle& t : cut(points)) {
    ++report.triangles_read;
    const Triangle named = {corners[t[0]], corners[t[1]], corners[t[2]]};
    if (!repeats_a_vertex(named)) add_triangle(named, color, transparency, texture, t);
  }
}

std::vector<Triangle> GeometryBuilder::cut(const std::vector<Vector3d>& outline, bool convex) {
  constexpr size_t max_work = 1'000'000'000;  // some seconds
  if (cutting_work_ > max_work) fail("expected fewer faces of many corners that are not convex");
  return triangulate(outline, convex, &cutting_work_);
}

// beyond this, 32 bits do not resolve the pixels of an image
static constexpr double farthest_uv = 1e5;

// files contain values that cannot be displayed
static float clamped_share(float x) { return x >= 0 ? std::min(x, 1.0f) : 0.0f; }

void GeometryBuilder::add_triangle(const Triangle& t, const Eigen::Vector3f& given,
                                   float transparency, const FaceTexture* texture,
                                   const Triangle& of_face) {
  const Eigen::Vector3f color = given.unaryExpr(&clamped_share);
  if (mesh_.triangles.size() >= max_triangles_)
    fail("expected at most {} triangles{}", max_triangles_, for_its_size());
  if (mesh_.triangles.size() % 1024 == 0) progress.check();
  mesh_.triangles.push_back(t);
  colors_.push_back(color);
  if (texture) {
    textured_.resize(mesh_.triangles.size());
    textured_.back().texture = texture->number;
    for (int k = 0; k < 3; ++k)
      textured_.back().uv[k] =
          texture->uv[of_face[k]].cwiseMax(-farthest_uv).cwiseMin(farthest_uv).cast<float>();
  }

  // the color of the body is the mean over its area
  const Vector3d& p = mesh_.vertices[t[0]];
  const double area = (mesh_.vertices[t[1]] - p).cross(mesh_.vertices[t[2]] - p).norm();
  if (!std::isfinite(area)) return;
  weighted_color_ += area * color.cast<double>();
  weighted_transparency_ += area * clamped_share(transparency);
  weight_ += area;
}

Bounds GeometryBuilder::bounds() const {
  Bounds bounds;
  for (const Triangle& t : mesh_.triangles)
    for (const int v : t) bounds.add(mesh_.vertices[v]);
  return bounds;
}

void GeometryBuilder::transform(double factor, const Eigen::Matrix3d& turn) {
  const bool turns = turn != Eigen::Matrix3d::Identity();
  for (Vector3d& p : mesh_.vertices) {
    if (turns) p = turn * p;
    if (factor != 1) p *= factor;
  }
}

Appearance GeometryBuilder::mean_appearance(const std::vector<int>& kept) const {
  Appearance out;
  out.given = true;
  if (!(weight_ > 0)) return out;
  out.color = (weighted_color_ / weight_).cast<float>();
  out.transparency = static_cast<float>(weighted_transparency_ / weight_);
  bool differ = false;
  for (const int i : kept) differ = differ || colors_[i] != colors_[kept.front()];
  if (!differ)
    out.color = colors_[kept.front()];
  else
    for (const int i : kept) out.triangle_colors.push_back(colors_[i]);
  return out;
}

SkinPtr GeometryBuilder::places(const std::vector<int>& kept) const {
  if (textured_.empty()) return nullptr;
  auto out = std::make_shared<Skin>();
  out->textures = textures;
  for (const int i : kept)
    out->triangles.push_back(static_cast<size_t>(i) < textured_.size() ? textured_[i]
                                                                       : TexturedTriangle{});
  return out;
}

Geometry GeometryBuilder::finish(bool colors_given, const std::string& subject,
                                 const ReadOptions& options) {
  Geometry out;
  out.report = report;
  if (mesh_.triangles.empty()) return out;
  check_reach(subject);

  Surface s;
  s.kept.resize(mesh_.triangles.size());
  std::iota(s.kept.begin(), s.kept.end(), 0);
  s.mesh = std::move(mesh_);
  const size_t gathered = s.mesh.vertices.size();
  if (!loose_) {
    s = without_unused_vertices(s);
    out.report.unused_vertices = static_cast<int>(gathered - s.mesh.vertices.size());
    out.report.vertices_read = static_cast<int>(s.mesh.vertices.size());
  }
  progress.check();
  const size_t used = s.mesh.vertices.size();
  check_mesh(s.mesh, subject);

  // repair open edges; separate triangles have only open edges: they connect by position alone
  if (!loose_) s.faults = find_faults(s.mesh, progress);
  progress.check();
  if (loose_ || !s.faults.closed()) weld_places(s, loose_, progress);
  if (loose_ && s.mesh.vertices.size() == used) s.faults = find_faults(s.mesh, progress);
  progress.check();
  if (s.faults.open_edges > 0) weld_seams(s, progress);
  progress.check();
  if (!keeps_triangles && !s.faults.closed() && s.faults.degenerate_triangles > 0)
    drop_flat_triangles(s, progress);
  if (!keeps_triangles && !s.faults.closed() && s.faults.duplicate_triangles > 0)
    drop_doubled_triangles(s, progress);
  out.report.welded_vertices = static_cast<int>(used - s.mesh.vertices.size());
  out.report.dropped_triangles =
      out.report.triangles_read - static_cast<int>(s.mesh.triangles.size());

  progress.check();
  out.report.flipped = turn_outward(s.mesh);
  if (out.report.flipped)
    options.diagnostics.repaired(Place(subject), "{}", std::string_view(inside_out).substr(2));
  out.places = places(s.kept);
  if (out.report.flipped) out.places = turned_over(out.places);
  if (colors_given) {
    out.appearance = mean_appearance(s.kept);
    if (!textures.empty()) out.appearance.skin = out.places;
  }
  out.mesh = std::move(s.mesh);
  return out;
}

}  // namespace clench
