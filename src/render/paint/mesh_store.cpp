#include "clench/render/paint/mesh_store.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "clench/base/watched.h"
#include "clench/render/mesh/corner_normals.h"
#include "clench/render/mesh/outward.h"
#include "clench/render/mesh/pieces.h"

namespace clench {

std::vector<TexturedRun> share_corners(const std::vector<Eigen::Vector3d>& vertices,
                                       const std::vector<Triangle>& triangles,
                                       const std::vector<Eigen::Vector3f>& colors,
                                       std::vector<Corner>& corners, std::vector<uint32_t>& indices,
                                       const SkinPtr& skin) {
  const auto normals = corner_normals(vertices, triangles);
  // corners of a vertex so far, as a linked list; end: -1
  std::vector<int> first(vertices.size(), -1), next;
  const size_t base = corners.size();
  std::vector<Paint> paints;
  for (const auto& color : colors) paints.push_back(make_paint(color, 1));
  const TextureOrder order(triangles.size(), skin);
  std::vector<TexturedRun> runs;
  StopCheck check(1 << 12);
  size_t done = 0;
  for (size_t group = 0; group < order.counts.size(); ++group) {
    const size_t start = indices.size();
    for (const size_t end = done + order.counts[group]; done < end; ++done) {
      check();
      const int i = order.triangles[done];
      if (normals[i][0].isZero()) continue;
      for (int k = 0; k < 3; ++k) {
        const int v = triangles[i][k];
        const Corner corner{vertices[v].cast<float>(), normals[i][k],
                            group == 0 ? paints[paints.size() == 1 ? 0 : i]
                                       : paint_of_place(skin->triangles[i].uv[k])};
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
    if (group > 0 && indices.size() > start)
      runs.push_back({static_cast<int>(start), static_cast<int>(indices.size() - start),
                      static_cast<int>(group) - 1});
  }
  return runs;
}

const StoredMesh& MeshStore::at(const DrawMesh& mesh) {
  const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
    return entry.shape == mesh.shape && entry.colors == mesh.triangle_colors &&
           entry.skin == mesh.skin;
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
  const auto runs =
      share_corners(vertices, from.triangles,
                    painted ? mesh.triangle_colors : std::vector{Eigen::Vector3f(1, 1, 1)}, corners,
                    indices, mesh.skin);
  LoadedTextures textures = mesh.skin ? LoadedTextures(mesh.skin->textures) : LoadedTextures();
  entries_.push_front(
      {mesh.shape, mesh.triangle_colors, mesh.skin, StoredMesh(corners, indices), 0});
  Entry& entry = entries_.front();
  entry.mesh.textured = runs;
  entry.mesh.textures = std::move(textures);
  entry.mesh.center = center;
  entry.mesh.scale = scale;
  entry.mesh.painted = painted;
  entry.mesh.closed = faces_outward(*mesh.shape);
  entry.bytes = corners.size() * sizeof(Corner) + indices.size() * sizeof(uint32_t) +
                entry.colors.size() * sizeof(Eigen::Vector3f) + entry.mesh.textures.bytes() +
                (mesh.skin ? mesh.skin->bytes() : 0);
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
