#include "clench/render/mesh/extent.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/render/mesh/pieces.h"

namespace clench {

Extent extent_of(const Scene& scene) {
  Bounds bounds;
  double scale = 0;
  Extent out;
  const auto each_of_meshes = [&](bool background, const auto& what) {
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
      const DrawMesh& mesh = scene.meshes[i];
      if (!mesh.shape || mesh.opacity == 0 || mesh.background != background) continue;
      for (const auto& p : mesh.shape->mesh().vertices) {
        const Eigen::Vector3d p_W = mesh.X_WM * p;
        if (!p_W.allFinite()) fail("picture: mesh {}: lies beyond all numbers", i + 1);
        what(p_W);
      }
    }
  };
  bool background = false;
  const auto each = [&](const auto& what) {
    each_of_meshes(background, what);
    for (const DrawCone& cone : scene.cones)
      for (const auto& p : cone_piece(cone).p_W) what(p);
    for (const DrawArrow& arrow : scene.arrows)
      for (const auto& p : arrow_piece(arrow).p_W) what(p);
  };
  const auto add = [&](const Eigen::Vector3d& p) { bounds.add(p); };
  each(add);
  if (bounds.empty()) {
    background = true;
    each(add);
  }
  if (bounds.empty()) return out;
  out.centre = 0.5 * bounds.low + 0.5 * bounds.high;
  each([&](const Eigen::Vector3d& p) { scale = std::max(scale, (p - out.centre).stableNorm()); });
  if (!std::isfinite(scale)) fail("picture: the scene is larger than numbers can be");
  // a single point is seen from a distance that its coordinates can resolve
  out.scale = std::max(scale, 1e-9 * std::max(1.0, out.centre.cwiseAbs().maxCoeff()));
  return out;
}

}  // namespace clench
