#include "scene/scene.h"

#include <algorithm>
#include <cmath>

#include "model/find.h"
#include "scene/palette.h"

namespace clench {
namespace {

constexpr double cone_size = 0.15;  // height of a cone, part of the object's largest radius

// what is drawn of a body; null when there is nothing to draw
const ShapePtr& drawn(const Body& body) {
  return body.appearance.visual ? body.appearance.visual : body.shape;
}

DrawMesh draw_body(const Body& body, const SceneOptions& options) {
  const palette::Entry entry = palette::of(body.kind);
  const Appearance& looks = body.appearance;
  DrawMesh mesh{
      .shape = drawn(body), .X_WM = body.X_WB, .color = entry.color, .triangle_colors = {}};
  if (options.file_colors && looks.given) {
    mesh.color = looks.color;
    mesh.triangle_colors = looks.triangle_colors;
    mesh.opacity = 1 - looks.transparency;
  }
  if (options.transparent_objects) mesh.opacity = std::min(mesh.opacity, entry.opacity);
  return mesh;
}

Bounds bounds_in_world(const Body& body) {
  Bounds bounds;
  if (drawn(body))
    for (const Eigen::Vector3d& p : drawn(body)->mesh().vertices) bounds.add(body.X_WB * p);
  return bounds;
}

// flat, and all else stands above its top and within its outline
bool is_floor(const Bounds& floor, const std::vector<Bounds>& all) {
  if (floor.empty() || floor.size().z() > 0.2 * floor.size().head<2>().maxCoeff()) return false;
  const double slack = 0.01 * floor.size().maxCoeff();
  return std::all_of(all.begin(), all.end(), [&](const Bounds& b) {
    return &b == &floor || b.empty() ||
           (b.low.z() >= floor.high.z() - slack &&
            (b.low.head<2>().array() >= floor.low.head<2>().array() - slack).all() &&
            (b.high.head<2>().array() <= floor.high.head<2>().array() + slack).all());
  });
}

std::vector<DrawCone> draw_contacts(const World& world) {
  std::vector<Id<Body>> parts, objects;
  for (const Id<Body> id : world.bodies()) {
    const BodyKind kind = world.body(id).kind;
    if (kind == BodyKind::object)
      objects.push_back(id);
    else if (kind != BodyKind::obstacle)
      parts.push_back(id);
  }
  std::vector<DrawCone> cones;
  for (const Contact& contact : contacts(world, parts, objects)) {
    const bool rubs = contact.kind == ContactKind::point && contact.friction.statics > 0;
    cones.push_back({.apex = contact.p_W,
                     .axis = contact.n_W,
                     .half_angle = rubs ? std::atan(contact.friction.statics) : 0,
                     .height = cone_size * world.body(contact.body).max_radius(),
                     .color = rubs ? palette::cone : palette::needle});
  }
  return cones;
}

}  // namespace

Scene make_scene(const World& world, const SceneOptions& options) {
  std::vector<Bounds> bounds;
  for (const Id<Body> id : world.bodies()) bounds.push_back(bounds_in_world(world.body(id)));

  Scene scene;
  bool floor = false;
  Bounds all;
  for (size_t i = 0; i < bounds.size(); ++i) {
    const Body& body = world.body(world.bodies()[i]);
    if (!drawn(body)) continue;
    scene.meshes.push_back(draw_body(body, options));
    scene.meshes.back().background = body.kind == BodyKind::obstacle && is_floor(bounds[i], bounds);
    floor = floor || scene.meshes.back().background;
    all.add(bounds[i].low), all.add(bounds[i].high);
  }
  if (options.contacts) scene.cones = draw_contacts(world);
  if (options.ground && !floor && !all.empty()) scene.ground = all.low.z();
  scene.eye = options.eye;
  return scene;
}

}  // namespace clench
