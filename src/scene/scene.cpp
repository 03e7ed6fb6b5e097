#include "clench/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <span>

#include "clench/base/error.h"
#include "clench/model/find.h"
#include "clench/scene/cones.h"
#include "clench/scene/palette.h"
#include "clench/scene/touched.h"

namespace clench {
namespace {

constexpr float see_through_opacity = 0.2f;

// mesh of a body; null if there is nothing to draw
const ShapePtr& drawn(const Body& body) {
  return body.appearance.visual ? body.appearance.visual : body.shape;
}

DrawMesh draw_body(const Body& body, const Pose& X_WB, const SceneOptions& options) {
  const palette::Entry entry = palette::of(body.kind);
  const Appearance& looks = body.appearance;
  DrawMesh mesh{.shape = drawn(body), .X_WM = X_WB, .color = entry.color, .triangle_colors = {}};
  if (options.file_colors && looks.given) {
    mesh.color = looks.color;
    mesh.triangle_colors = looks.triangle_colors;
    mesh.skin = looks.skin;
    mesh.opacity = 1 - looks.transparency;
  }
  if (body.kind == BodyKind::link &&
      std::ranges::find(options.see_through, body.robot) != options.see_through.end())
    mesh.opacity = std::min(mesh.opacity, see_through_opacity), mesh.hides = true;
  if (options.transparent_objects) mesh.opacity = std::min(mesh.opacity, entry.opacity);
  return mesh;
}

Bounds bounds_in_world(const Body& body, const Pose& X_WB) {
  Bounds bounds;
  if (drawn(body))
    for (const Eigen::Vector3d& p : drawn(body)->mesh().vertices) bounds.add(X_WB * p);
  return bounds;
}

// flat, and everything else is above its top and within its outline
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

constexpr int patch_rings = 8, patch_segments = 48;
constexpr double patch_force = 5;  // [N]
constexpr double rim = 0.85;       // an ellipse is drawn as its rim, from this fraction outward

// z = height(x, y) over an ellipse from `inner` of its size outward, in its own frame
template <class Height>
DrawMesh draw_cap(const Pose& X_WP, std::array<double, 2> axes, double inner,
                  const Eigen::Vector3f& color, Height height) {
  Mesh mesh;
  for (int r = 0; r <= patch_rings; ++r)
    for (int s = 0; s < patch_segments; ++s) {
      const double part = inner + (1 - inner) * r / patch_rings;
      const double angle = 2 * std::numbers::pi * s / patch_segments;
      const double x = part * axes[0] * std::cos(angle), y = part * axes[1] * std::sin(angle);
      mesh.vertices.push_back({x, y, height(x, y)});
    }
  const auto at = [](int r, int s) { return r * patch_segments + s % patch_segments; };
  for (int r = 0; r < patch_rings; ++r)
    for (int s = 0; s < patch_segments; ++s) {
      if (r > 0 || inner > 0) mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
      mesh.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
    }
  return {.shape = Shape::make(std::move(mesh), "patch"), .X_WM = X_WP, .color = color};
}

// the fitted surface of the object of the two, and the rim of the ellipse on it
void draw_patch(const World& world, const Contact& contact, int index, std::vector<DrawMesh>& out) {
  const SoftPatch patch = soft_patch(*contact.site);
  const auto is_object = [&](Id<Body> id) { return world.body(id).kind == BodyKind::object; };
  const bool on_other = !is_object(contact.body) && is_object(contact.other);
  const bool on_b = contact.body_is_b != on_other;
  const SurfaceFit& fit = patch.surfaces[on_b ? 1 : 0];
  // +z into the body; along the relative directions
  const Eigen::Vector3d inward = (on_b ? 1 : -1) * patch.normal_A;
  Eigen::Matrix3d axes;
  axes << patch.directions.col(0), inward.cross(patch.directions.col(0)), inward;
  const Pose X_WP = contact.X_WA * Pose{Eigen::Quaterniond(axes), patch.center_A};
  const Eigen::Matrix<double, 3, 2> across = axes.transpose() * fit.directions;
  const auto surface = [&](double lift) {
    return [&, lift](double x, double y) {
      const Eigen::Vector2d p = across.topRows<2>().transpose() * Eigen::Vector2d(x, y);
      return 0.5 * fit.curvatures.dot(p.cwiseAbs2()) + lift;
    };
  };
  // slightly within the body, the ellipse deeper than the surface below it
  const double step = 0.02 * patch.radius;
  out.push_back(draw_cap(X_WP, {patch.radius, patch.radius}, 0, palette::patch, surface(step)));
  const auto semi_axes = contact_ellipse(patch, patch_force).semi_axes;
  const bool pressed = semi_axes[0] > 0 && semi_axes[1] > 0;
  if (pressed) out.push_back(draw_cap(X_WP, semi_axes, rim, palette::ellipse, surface(2 * step)));
  const Shown shown{.kind = Shown::Kind::site,
                    .body = on_other ? contact.other : contact.body,
                    .other = on_other ? contact.body : contact.other,
                    .index = index};
  for (size_t i = out.size() - (pressed ? 2 : 1); i < out.size(); ++i) out[i].shown = shown;
}

void draw_patches(const World& world, std::vector<DrawMesh>& out) {
  std::set<const SoftSite*> drawn_sites;
  const std::vector<Contact> all = contacts(world);
  for (size_t i = 0; i < all.size(); ++i)
    if (all[i].site && drawn_sites.insert(all[i].site.get()).second)
      draw_patch(world, all[i], static_cast<int>(i), out);
}

// length of an arrow and radius of its rod, in proportion to the robot's size
constexpr double approach_length = 0.4, approach_radius = 0.012;

// arrows of closing robots, from the approach point on
void draw_approaches(const World& world, Scene& scene) {
  for (const auto id : world.robots()) {
    const Robot& robot = world.robot(id);
    const auto closes = [](const DofSpec& dof) { return dof.default_velocity != 0; };
    if (std::ranges::none_of(robot.dofs, closes)) continue;
    Bounds bounds;
    for (const auto part : world.bodies_of(id)) {
      const Bounds b = bounds_in_world(world.body(part), world.pose(part));
      if (!b.empty()) bounds.add(b.low), bounds.add(b.high);
    }
    if (bounds.empty()) continue;
    const double size = bounds.size().norm();
    const Pose X_WA = world.pose(robot.base) * robot.X_BA;
    scene.arrows.push_back({.tail = X_WA.position,
                            .tip = X_WA * Eigen::Vector3d(0, 0, approach_length * size),
                            .radius = approach_radius * size,
                            .color = palette::approach,
                            .shown = {.kind = Shown::Kind::approach, .body = robot.base}});
  }
}

}  // namespace

Scene make_scene(const World& world, const SceneOptions& options) {
  std::vector<Bounds> bounds;
  for (const Id<Body> id : world.bodies())
    bounds.push_back(bounds_in_world(world.body(id), world.pose(id)));

  std::vector<Contact> touches;
  if (options.contacts || options.framing == Framing::contacts)
    touches = contacts_on_objects(world);
  const std::set<Id<Body>> touched = touched_bodies(world, touches);

  Scene scene;
  bool floor = false;
  Bounds all;
  for (size_t i = 0; i < bounds.size(); ++i) {
    const Body& body = world.body(world.bodies()[i]);
    if (!drawn(body)) continue;
    scene.meshes.push_back(draw_body(body, world.pose(world.bodies()[i]), options));
    scene.meshes.back().background = body.kind == BodyKind::obstacle && is_floor(bounds[i], bounds);
    scene.meshes.back().shown = {.kind = Shown::Kind::body, .body = world.bodies()[i]};
    scene.meshes.back().framed =
        options.framing == Framing::all || touched.empty() || touched.contains(world.bodies()[i]);
    floor = floor || scene.meshes.back().background;
    all.add(bounds[i].low), all.add(bounds[i].high);
  }
  if (options.patches) draw_patches(world, scene.meshes);
  if (options.approach) draw_approaches(world, scene);
  const std::vector<TouchPatch> patches = touch_patches(touches);
  scene.spots = patch_spots(world, patches);
  if (options.contacts) scene.cones = contact_cones(world, patches, options);
  if (options.ground && !floor && !all.empty())
    scene.ground = options.ground_height.value_or(all.low.z());
  scene.eye = options.eye;
  return scene;
}

}  // namespace clench
