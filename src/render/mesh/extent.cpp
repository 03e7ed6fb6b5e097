#include "clench/render/mesh/extent.h"

#include "clench/render/mesh/pieces.h"

namespace clench {

Eye Extent::to_scene(const Eye& world) const {
  Eye out = world;
  out.eye = (world.eye - centre) / scale;
  out.target = (world.target - centre) / scale;
  out.ortho_height = world.ortho_height / scale;
  return out;
}

Extent extent_of(const Scene& scene) {
  std::vector<Eigen::Vector3d> marks;
  const auto append = [&](const Piece& piece) {
    marks.insert(marks.end(), piece.p_W.begin(), piece.p_W.end());
  };
  for (const DrawCone& cone : scene.cones) append(cone_piece(cone));
  for (const DrawArrow& arrow : scene.arrows) append(arrow_piece(arrow));
  const auto ball = [&](bool background) {
    return ball_around([&](const auto& what) {
      for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const DrawMesh& mesh = scene.meshes[i];
        if (!mesh.shape || mesh.opacity == 0 || mesh.background != background) continue;
        const Eigen::Matrix3d R = mesh.X_WM.rotation.toRotationMatrix();
        for (const auto& p : mesh.shape->mesh().vertices) {
          const Eigen::Vector3d p_W = R * p + mesh.X_WM.position;
          if (!p_W.allFinite()) fail("picture: mesh {}: lies beyond all numbers", i + 1);
          what(p_W);
        }
      }
      for (const auto& p : marks) what(p);
    });
  };
  if (const auto bodies = ball(false)) return *bodies;
  return ball(true).value_or(Extent{});
}

}  // namespace clench
