#include "clench/render/paint/mesh_store.h"

#include <algorithm>
#include <cstring>

#include "clench/base/watched.h"
#include "clench/render/mesh/corner_normals.h"
#include "clench/render/mesh/outward.h"

namespace clench {

void share_corners(const std::vector<Eigen::Vector3d>& vertices,
                   const std::vector<Triangle>& triangles,
                   const std::vector<Eigen::Vector3f>& colors, std::vector<Corner>& corners,
                   std::vector<uint32_t>& indices) {
  const auto normals = corner_normals(vertices, triangles);
  // corners of a vertex so far, as a chain; none: -1
  std::vector<int> first(vertices.size(), -1), next;
  const size_t base = corners.size();
  std::vector<Paint> paints;
  for (const auto& color : colors) paints.push_back(make_paint(color, 1));
  StopCheck check(1 << 12);
  for (size_t i = 0; i < triangles.size(); ++i) {
    check();
    if (normals[i][0].isZero()) continue;
    const Paint& paint = paints[paints.size() == 1 ? 0 : i];
    for (int k = 0; k < 3; ++k) {
      const int v = triangles[i][k];
      const Corner corner{vertices[v].cast<float>(), normals[i][k], paint};
      int at = first[v];
      while (at >= 0 && std::memcmp(&corners[base + at], &corner, sizeof corner) != 0)
        at = next[at];
      if (at < 0) {
        at = static_cast<int>(next.size());
        next.push_back(first[v]);
        first[v] = at;
        corners.push_back(corner);
      }
      indices.push_back(static_cast<uint32_t>(base + at));
    }
  }
}

const StoredMesh& MeshStore::at(const DrawMesh& mesh) {
  const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
    return entry.shape == mesh.shape && entry.colors == mesh.triangle_colors;
  });
  if (found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return entries_.front().mesh;
  }
  const Mesh& from = mesh.shape->mesh();
  const Eigen::Vector3d center = mesh.shape->center();
  const double scale = mesh.shape->radius() > 0 ? mesh.shape->radius() : 1;
  std::vector<Eigen::Vector3d> vertices = from.vertices;
  for (auto& p : vertices) p = (p - center) / scale;
  const bool painted = !mesh.triangle_colors.empty();
  std::vector<Corner> corners;
  std::vector<uint32_t> indices;
  share_corners(vertices, from.triangles,
                painted ? mesh.triangle_colors : std::vector{Eigen::Vector3f(1, 1, 1)}, corners,
                indices);
  entries_.push_front({mesh.shape, mesh.triangle_colors, StoredMesh(corners, indices), 0});
  Entry& entry = entries_.front();
  entry.mesh.center = center;
  entry.mesh.scale = scale;
  entry.mesh.painted = painted;
  entry.mesh.closed = faces_outward(*mesh.shape);
  entry.bytes = corners.size() * sizeof(Corner) + indices.size() * sizeof(uint32_t) +
                entry.colors.size() * sizeof(Eigen::Vector3f);
  bytes_ += entry.bytes;
  return entry.mesh;
}

void MeshStore::trim() {
  while (bytes_ > most_ && !entries_.empty()) {
    bytes_ -= entries_.back().bytes;
    entries_.pop_back();
  }
}

}  // namespace clench
