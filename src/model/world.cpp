#include "clench/model/world.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/spec/check_robot.h"
#include "clench/spec/inertia.h"

namespace clench {

std::string World::the_body(const std::string& name) {
  return fmt::format("body '{}'", excerpt(name));
}

const Body& World::body(Id<Body> id) const { return follow(model_->bodies, id, "body"); }
const Robot& World::robot(Id<Robot> id) const { return follow(model_->robots, id, "robot"); }

// --- shared parts ---

template <class Part>
static Part& own(std::shared_ptr<Part>& part) {
  if (part.use_count() > 1) part = std::make_shared<Part>(*part);
  // the last other owner may have released it in another thread
  std::atomic_thread_fence(std::memory_order_acquire);
  return *part;
}

WorldModel& World::edit_model() {
  own(model_).stamp = ++lineage_->stamps;
  return *model_;
}

WorldSettings& World::edit_settings() {
  own(settings_).stamp = ++lineage_->stamps;
  return *settings_;
}

Body& World::edit(Id<Body> id) { return body(id), edit_model().bodies[id.index].value; }
Robot& World::edit(Id<Robot> id) { return robot(id), edit_model().robots[id.index].value; }
bool World::alive(Id<Body> id) const { return holds(model_->bodies, id); }
bool World::alive(Id<Robot> id) const { return holds(model_->robots, id); }

// --- names ---

template <class T>
static Id<T> find_name(const std::map<std::string, Id<T>, std::less<>>& names,
                       std::string_view name) {
  const auto found = names.find(name);
  return found == names.end() ? Id<T>{} : found->second;
}

Id<Body> World::find_body(std::string_view name) const {
  return find_name(model_->body_names, name);
}

Id<Robot> World::find_robot(std::string_view name) const {
  return find_name(model_->robot_names, name);
}

void World::check_name_is_free(const std::string& name) const {
  if (!name.empty() && (find_body(name) || find_robot(name)))
    fail("the name '{}' is taken in this world", excerpt(name));
}

std::string World::unique_name(const std::string& expected) {
  const std::string stem = expected.empty() ? "body" : expected;
  std::string name = stem;
  // the count of a name is cached, so that naming a thousand boxes is fast
  int& count = edit_model().counts[stem];
  while (find_body(name) || find_robot(name)) name = fmt::format("{}_{}", stem, ++count + 1);
  return name;
}

void World::set_name(Id<Body> id, const std::string& name) {
  if (name.empty()) fail("body '{}': a name may not be empty", excerpt(body(id).name));
  check_name(name, the_body(body(id).name));
  if (find_body(name) != id) check_name_is_free(name);
  WorldModel& model = edit_model();
  std::string& current = model.bodies[id.index].value.name;
  if (current == name) return;
  // allocations first: if memory runs out, the body keeps its name
  std::string changed = name;
  model.body_names[name] = id;
  model.body_names.erase(current);
  current.swap(changed);
}

// --- adding and removing ---

Id<Body> World::insert(Body body, Pose X_WB, const std::string& name) {
  check_name(name, "body");
  check_name_is_free(name);
  body.name = name.empty() ? unique_name(body.name) : name;
  Id<Body>& named = edit_model().body_names[body.name];
  const auto id = insert_slot(model_->bodies, std::move(body), next_serial());
  // by index: if memory runs out between the two, the next body still gets its own entry
  state_.X_WB.resize(id.index + 1);
  state_.X_WB[id.index] = X_WB;
  model_->body_order.push_back(id);
  named = id;
  return id;
}

Id<Body> World::add_body(const BodySpec& spec, BodyKind kind, Pose X_WB, const std::string& name) {
  check_body(spec, "body");
  check_appearance(spec.appearance, the_body(spec.name));
  check_place(X_WB, the_body(spec.name));
  Body body = make_body(spec, kind);
  body.material = settings_->materials.index(spec.material);
  return insert(std::move(body), X_WB, name);
}

void World::erase(Id<Body> id) {
  WorldModel& model = edit_model();
  model.bodies[id.index].used = false;
  model.body_names.erase(model.bodies[id.index].value.name);
  model.bodies[id.index].value.shape.reset();
  std::erase(model.body_order, id);
  WorldSettings& settings = edit_settings();
  settings.switched_off.erase(id);
  settings.collision_bits.erase(id);
  for (auto* pairs : {&settings.pairs_off, &settings.pairs_on})
    std::erase_if(*pairs, [&](const auto& pair) { return pair.first == id || pair.second == id; });
  settings.dynamics.surface_velocities.erase(id);
  std::erase_if(settings.dynamics.welds,
                [&](const auto& weld) { return weld.first == id || weld.second == id; });
  if (state_.dynamics) {
    DynamicState& state = edit_dynamics();
    std::erase_if(state.manifolds, [&](const Manifold& m) { return m.a == id || m.b == id; });
    state.twists[id.index] = state.solved[id.index] = {};
    state.loads[id.index] = {};
  }
  scratch_.context.forget(id);
}

void World::remove(Id<Body> id) {
  const Body& gone = body(id);
  if (gone.robot)
    fail("body '{}' is a part of robot '{}': remove the robot", excerpt(gone.name),
         excerpt(robot(gone.robot).name));
  erase(id);
}

// --- settings ---

void World::add_friction(const OwnFriction& own) { edit_settings().materials.add(own); }

void World::set_contact_threshold(double threshold) {
  check(contact_threshold_rule, threshold, "world");
  edit_settings().contact_threshold = threshold;
}

void World::set_camera(const std::optional<Camera>& camera) {
  if (camera) check_camera(*camera);
  edit_settings().camera = camera;
}

// --- snapshots ---

std::shared_ptr<const Snapshot> World::snapshot() const {
  return std::make_shared<Snapshot>(Snapshot{lineage_, model_, settings_, state_});
}

void WorldState::reserve_for(const WorldState& other) {
  X_WB.reserve(other.X_WB.size());
  dofs.reserve(other.dofs.size());
  joints.reserve(other.joints.size());
  follows_dof.reserve(other.follows_dof.size());
}

void World::restore(const Snapshot& snapshot) {
  if (snapshot.lineage != lineage_)
    fail("world: the snapshot belongs to another world, of which this is no clone");
  // if memory runs out nothing has been changed yet
  state_.reserve_for(snapshot.state);
  // both are copied before they are changed
  model_ = std::const_pointer_cast<WorldModel>(snapshot.model);
  settings_ = std::const_pointer_cast<WorldSettings>(snapshot.settings);
  state_ = snapshot.state;
}

}  // namespace clench
