#include "clench/scene/film_scene.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "clench/scene/touched.h"

namespace clench {
namespace {

constexpr size_t max_keys = 12;  // maximum number of states whose bodies are drawn

// states whose bodies are drawn: evenly spaced, including the first and the last
std::vector<size_t> key_states(size_t count) {
  const size_t keys = std::min(count, max_keys);
  std::vector<size_t> out;
  for (size_t k = 0; k < keys; ++k) out.push_back(keys > 1 ? k * (count - 1) / (keys - 1) : 0);
  return out;
}

// for each body that a view must hold, by name: the last state in which it must
using Wanted = std::map<std::string, size_t>;

Wanted wanted_bodies(std::span<const World* const> states, std::span<const size_t> keys) {
  Wanted out;
  for (const size_t k : keys) {
    const World& world = *states[k];
    for (const Id<Body> id : touched_bodies(world, contacts_on_objects(world))) {
      const Body& body = world.body(id);
      out[body.name] = body.kind == BodyKind::object ? k : states.size();
    }
  }
  return out;
}

bool is_wanted(const Wanted& wanted, const std::string& name, size_t state) {
  const auto at = wanted.find(name);
  return at != wanted.end() && state <= at->second;
}

bool same_pose(const Pose& a, const Pose& b) {
  return a.position == b.position && a.rotation.coeffs() == b.rotation.coeffs();
}

// corners of the boxes of bodies that have moved since the previous state
void hold_boxes(const World& world, const World& before, size_t state, const Wanted& wanted,
                Scene& scene) {
  for (const Id<Body> id : world.bodies()) {
    const Body& body = world.body(id);
    const ShapePtr& shape = body.appearance.visual ? body.appearance.visual : body.shape;
    if (!shape || body.kind == BodyKind::obstacle) continue;
    if (!wanted.empty() && !is_wanted(wanted, body.name, state)) continue;
    const Pose& X_WB = world.pose(id);
    const Id<Body> same = before.find_body(body.name);
    if (same && same_pose(X_WB, before.pose(same))) continue;
    const Bounds& bounds = shape->bounds();
    if (bounds.empty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3d high(corner & 1, corner >> 1 & 1, corner >> 2);
      scene.held.push_back(X_WB *
                           Eigen::Vector3d(bounds.low.array() + high * bounds.size().array()));
    }
  }
}

// the names of the bodies that make_scene draws, in its order
std::vector<std::string> drawn_names(const World& world) {
  std::vector<std::string> out;
  for (const Id<Body> id : world.bodies()) {
    const Body& body = world.body(id);
    if (body.appearance.visual || body.shape) out.push_back(body.name);
  }
  return out;
}

// adds a mesh, unless an earlier key state has it at the same pose
void add_mesh(const DrawMesh& mesh, Scene& scene) {
  for (DrawMesh& other : scene.meshes)
    if (other.shape == mesh.shape && same_pose(other.X_WM, mesh.X_WM)) {
      other.framed = other.framed || mesh.framed;
      return;
    }
  scene.meshes.push_back(mesh);
}

void add_key(const World& world, size_t state, const Wanted& wanted, const SceneOptions& options,
             Scene& scene) {
  Scene one = make_scene(world, options);
  const std::vector<std::string> names = drawn_names(world);
  for (size_t i = 0; i < one.meshes.size(); ++i) {
    if (!wanted.empty() && i < names.size())
      one.meshes[i].framed = is_wanted(wanted, names[i], state);
    add_mesh(one.meshes[i], scene);
  }
  for (const DrawCone& cone : one.cones) scene.cones.push_back(cone);
  for (const DrawArrow& arrow : one.arrows) scene.arrows.push_back(arrow);
  for (const Eigen::Vector3d& spot : one.spots) scene.spots.push_back(spot);
  if (one.ground) scene.ground = std::min(*one.ground, scene.ground.value_or(*one.ground));
}

}  // namespace

Scene make_film_scene(std::span<const World* const> states, const SceneOptions& options) {
  if (states.size() == 1) return make_scene(*states[0], options);
  const std::vector<size_t> keys = key_states(states.size());
  Wanted wanted;
  if (options.framing == Framing::contacts) wanted = wanted_bodies(states, keys);
  Scene scene;
  for (const size_t k : keys) add_key(*states[k], k, wanted, options, scene);
  for (size_t i = 1; i < states.size(); ++i)
    hold_boxes(*states[i], *states[i - 1], i, wanted, scene);
  scene.eye = options.eye;
  return scene;
}

}  // namespace clench
