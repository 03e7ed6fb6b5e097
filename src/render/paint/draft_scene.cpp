#include "clench/render/paint/draft_scene.h"

#include <algorithm>
#include <cmath>

#include "clench/render/mesh/draw_list.h"
#include "clench/render/mesh/outward.h"
#include "clench/render/mesh/pieces.h"
#include "clench/render/paint/tile.h"

namespace clench {
namespace {

Eigen::Matrix4d moved_by(const DrawMesh& mesh, const StoredMesh& stored, const Extent& extent) {
  Eigen::Matrix4d out = Eigen::Matrix4d::Identity();
  out.topLeftCorner<3, 3>() = mesh.X_WM.rotation.toRotationMatrix() * (stored.scale / extent.scale);
  out.topRightCorner<3, 1>() = (mesh.X_WM * stored.center - extent.center) / extent.scale;
  return out;
}

PlacedMesh place(const DrawMesh& mesh, const StoredMesh& stored, const DraftScene& scene) {
  PlacedMesh placed{.mesh = &stored,
                    .shape = mesh.shape,
                    .to_scene = moved_by(mesh, stored, scene.extent),
                    .background = mesh.background};
  const Eigen::Vector3d center = placed.to_scene.topRightCorner<3, 1>();
  placed.paint << linear_rgb(mesh.color), mesh.opacity;
  placed.distance = (center - scene.eye.eye).norm();
  placed.one_side =
      stored.closed && hides_inside(center, stored.scale / scene.extent.scale, scene.eye);
  return placed;
}

std::optional<StoredMesh> load_floor(const Scene& scene, const Extent& extent, const Eye& eye) {
  if (!scene.ground) return std::nullopt;
  const double ground = (*scene.ground - extent.center.z()) / extent.scale;
  if (std::abs(ground) > floor_reach || shading_eye(eye).z() <= ground) return std::nullopt;
  const auto z = static_cast<float>(ground), r = static_cast<float>(floor_reach);
  std::vector<Corner> corners;
  for (const auto& [x, y] :
       {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)})
    corners.push_back({{x, y, z}, {0, 0, 1}, {}});
  return StoredMesh(corners, std::vector<uint32_t>{0, 1, 2, 0, 2, 3});
}

}  // namespace

const StoredMesh* DraftMarks::at(const Scene& scene, const Extent& extent) {
  Scene marks;
  marks.cones = scene.cones, marks.arrows = scene.arrows;
  const bool same_place = extent.center == extent_.center && extent.scale == extent_.scale;
  if (key_ && same_place && key_->matches(marks)) return mesh_ ? &*mesh_ : nullptr;
  key_.reset(), mesh_.reset();
  std::vector<Corner> corners;
  std::vector<uint32_t> indices;
  const auto add = [&](Piece piece) {
    for (auto& p : piece.p_W) p = (p - extent.center) / extent.scale;
    share_corners(piece.p_W, piece.triangles, piece.colors, corners, indices);
  };
  for (const DrawCone& cone : scene.cones) add(cone_piece(cone));
  for (const DrawArrow& arrow : scene.arrows) add(arrow_piece(arrow));
  if (!indices.empty()) {
    mesh_.emplace(corners, indices);
    mesh_->painted = true;
  }
  key_.emplace(marks);
  extent_ = extent;
  return mesh_ ? &*mesh_ : nullptr;
}

DraftScene load_draft(MeshStore& store, DraftMarks& marks, const Scene& scene, const Extent& extent,
                      const Eye& eye, const Progress& progress) {
  DraftScene out{.extent = extent, .eye = extent.to_scene(eye)};
  for (const DrawMesh& mesh : scene.meshes) {
    if (!mesh.shape || mesh.opacity == 0) continue;
    progress.tell(0.1, "drawing");
    auto& group = mesh.opacity >= solid_from || mesh.background ? out.solid : out.clear;
    group.push_back(place(mesh, store.at(mesh), out));
  }
  std::ranges::stable_sort(out.solid, std::ranges::less{}, &PlacedMesh::distance);
  std::ranges::stable_sort(out.clear, std::ranges::greater{}, &PlacedMesh::distance);
  out.marks = marks.at(scene, extent);
  out.floor = load_floor(scene, extent, out.eye);
  return out;
}

}  // namespace clench
