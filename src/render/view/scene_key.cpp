#include "clench/render/view/scene_key.h"

#include <algorithm>

namespace clench {

namespace {

// shapes of contact patches are made anew for each scene
bool same(const ShapePtr& a, const ShapePtr& b) {
  if (a == b) return true;
  return a && b && a->hash() == b->hash() && a->mesh().vertices == b->mesh().vertices &&
         a->mesh().triangles == b->mesh().triangles;
}

bool same(const DrawMesh& a, const DrawMesh& b) {
  return same(a.shape, b.shape) && a.X_WM.position == b.X_WM.position &&
         a.X_WM.rotation.coeffs() == b.X_WM.rotation.coeffs() && a.color == b.color &&
         a.opacity == b.opacity && a.background == b.background && a.framed == b.framed &&
         a.hides == b.hides && a.triangle_colors == b.triangle_colors && a.skin == b.skin;
}

bool same(const DrawCone& a, const DrawCone& b) {
  return a.apex == b.apex && a.axis == b.axis && a.half_angle == b.half_angle &&
         a.height == b.height && a.color == b.color;
}

bool same(const DrawArrow& a, const DrawArrow& b) {
  return a.tail == b.tail && a.tip == b.tip && a.radius == b.radius && a.color == b.color;
}

template <class T>
bool all_same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(a, b, [](const T& x, const T& y) { return same(x, y); });
}

}  // namespace

SceneKey::SceneKey(const Scene& scene)
    : meshes(scene.meshes),
      cones(scene.cones),
      arrows(scene.arrows),
      ground(scene.ground),
      spots(scene.spots),
      held(scene.held) {}

bool SceneKey::matches(const Scene& scene) const {
  return ground == scene.ground && spots == scene.spots && held == scene.held &&
         all_same(cones, scene.cones) && all_same(arrows, scene.arrows) &&
         all_same(meshes, scene.meshes);
}

}  // namespace clench
