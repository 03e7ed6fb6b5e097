#include "clench/model/world.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/spec/check_robot.h"
#include "clench/spec/inertia.h"

namespace clench {

// --- slots ---

template <class T>
static bool holds(const std::vector<Slot<T>>& slots, Id<T> id) {
  return id.index < slots.size() && slots[id.index].used && slots[id.index].serial == id.serial;
}

// the object of an id, or an error that names what the id referred to
template <class T>
static const T& follow(const std::vector<Slot<T>>& slots, Id<T> id, const char* what) {
  if (holds(slots, id)) return slots[id.index].value;
  if (id.index < slots.size() && slots[id.index].serial == id.serial)
    fail(ErrorKind::stale, "{} '{}' was removed from its world", what,
         excerpt(slots[id.index].value.name));
  fail(ErrorKind::stale, "this {} is no longer in its world", what);
}

template <class T>
static Id<T> insert_slot(std::vector<Slot<T>>& slots, T value, uint32_t serial) {
  slots.push_back({serial, true, std::move(value)});
  return {static_cast<uint32_t>(slots.size() - 1), serial};
}

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
  const Id<Body> holder = find_body(name);
  if ((holder && holder != id) || find_robot(name))
    fail("the name '{}' is taken in this world", excerpt(name));
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
  if (!name.empty() && (find_body(name) || find_robot(name)))
    fail("the name '{}' is taken in this world", excerpt(name));
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

// a part's name follows its robot's if that had to be changed
static std::string part_name(const std::string& part, const std::string& was,
                             const std::string& is) {
  return part.starts_with(was) ? is + part.substr(was.size()) : part;
}

Id<Robot> World::add_robot(const RobotSpec& spec, Pose X_WB, const std::string& name) {
  check_robot(spec);
  check_name(name, "robot");
  check_place(X_WB, fmt::format("robot '{}'", excerpt(spec.name)));
  if (!name.empty() && (find_robot(name) || find_body(name)))
    fail("the name '{}' is taken in this world", excerpt(name));

  Robot robot;
  robot.name = name.empty() ? unique_name(spec.name) : name;
  robot.source = spec.source;
  robot.file = spec.file;
  robot.class_name = spec.class_name;
  robot.dofs = spec.dofs;
  robot.X_BA = spec.X_BA.value_or(Pose{});
  robot.files = spec.files;
  robot.tracker = spec.tracker;
  robot.joint_tendons = spec.joint_tendons;
  if (PassiveParts parts{spec.tactile, spec.tendons, spec.wrappers, spec.actuators}; !parts.empty())
    robot.passive = std::make_shared<PassiveParts>(std::move(parts));
  if (spec.eigengrasps) robot.eigengrasps = std::make_shared<EigengraspSet>(*spec.eigengrasps);
  if (spec.virtual_contacts)
    robot.virtual_contacts =
        std::make_shared<std::vector<VirtualContactSpec>>(*spec.virtual_contacts);
  if (spec.glove) robot.glove = std::make_shared<GloveCalibration>(*spec.glove);
  for (const LinkSpec& link : spec.links) {
    const int first = static_cast<int>(robot.joints.size());
    for (const JointSpec& joint : link.joints)
      robot.joints.push_back({joint, static_cast<int>(robot.links.size())});
    robot.links.push_back(
        {{}, link.parent, first, static_cast<int>(robot.joints.size()), link.X_JL});
  }
  // actuators without force drive nothing
  for (int i = 0; i < static_cast<int>(spec.dofs.size()); ++i) {
    DofDrive drive = drive_of(spec, i);
    DofSpec& dof = robot.dofs[i];
    dof.driven = dof.driven && drive.acts();
    robot.drives.push_back(dof.driven ? std::move(drive) : DofDrive{{}, {}, dof.max_effort});
  }
  robot.chains = chains_of(spec);
  robot.first_dof = state_.dofs.size();
  robot.first_joint = state_.joints.size();
  for (int i = 0; i < static_cast<int>(spec.dofs.size()); ++i) {
    const auto range = dof_range(spec, i);
    robot.limits.push_back(range);
    robot.endless.push_back(dof_is_endless(spec, i));
    const double start = spec.dofs[i].default_value;
    state_.dofs.push_back(robot.endless.back() ? start : std::clamp(start, range[0], range[1]));
  }
  for (const Joint& joint : robot.joints) {
    state_.joints.push_back(joint.ratio * state_.dofs[robot.first_dof + joint.dof]);
    state_.follows_dof.push_back(true);
  }

  // the robot first, so that its parts refer to it
  const size_t count = bodies().size();
  const std::string own_name = robot.name;
  Id<Robot>& named = edit_model().robot_names[own_name];
  const auto id = insert_slot(model_->robots, std::move(robot), next_serial());
  model_->robot_order.push_back(id);
  named = id;
  std::optional<MaterialTable> materials;
  if (!spec.frictions.empty()) materials = settings_->materials;
  try {
    for (const OwnFriction& friction : spec.frictions) add_friction(friction);
    add_parts(id, spec, X_WB);
    place(id, X_WB);
  } catch (const Error&) {
    if (materials) edit_settings().materials = std::move(*materials);
    while (bodies().size() > count) erase(bodies().back());
    edit_model().robots[id.index].used = false;
    model_->robot_order.pop_back();
    model_->robot_names.erase(own_name);
    throw;
  }
  return id;
}

// base and links, and their pairs that never collide
void World::add_parts(Id<Robot> id, const RobotSpec& spec, const Pose& X_WB) {
  const std::string robot_name = robot(id).name;
  const auto add_part = [&](const BodySpec& part, BodyKind kind, int link) {
    BodySpec named = part;
    named.name = repaired_name(part_name(part.name, spec.name, robot_name));
    const auto body = add_body(named, kind, X_WB);
    edit(body).robot = id;
    edit(body).link = link;
    return body;
  };
  edit(id).base = add_part(spec.base, BodyKind::base, -1);
  for (int l = 0; l < static_cast<int>(spec.links.size()); ++l) {
    const auto body = add_part(spec.links[l].body, BodyKind::link, l);
    edit(id).links[l].body = body;
  }
  const Robot& made = robot(id);
  switch_off_neighbors(made, spec.chain_links_collide);
  for (const auto& [a, b] : spec.collision_rules.pairs_on)
    set_collision(true, made.body_of(a), made.body_of(b));
  for (const int off : spec.collision_rules.parts_off) set_collision(false, made.body_of(off));
  for (const auto& [a, b] : spec.collision_rules.pairs_off)
    set_collision(false, made.body_of(a), made.body_of(b));
}

// Neighbors never collide: a link and the nearest body with a shape on the way to the base. In
// GraspIt! robots no two links of a chain do, and the base never collides with a chain's first
// link.
void World::switch_off_neighbors(const Robot& robot, bool chain_links_collide) {
  std::vector<Id<Body>> shaped;  // by link: itself or its carrier
  for (const Link& link : robot.links) {
    const Id<Body> before = link.parent < 0 ? robot.base : shaped[link.parent];
    if (chain_links_collide || link.parent < 0) set_collision(false, before, link.body);
    shaped.push_back(body(link.body).shape ? link.body : before);
  }
  if (chain_links_collide) return;
  for (const Chain& chain : robot.chains)
    for (const int i : chain.links)
      for (const int j : chain.links)
        if (j < i) set_collision(false, robot.links[j].body, robot.links[i].body);
}

void World::mount(Id<Robot> child, Id<Robot> parent, int link, Pose X_LB, const BodySpec* piece) {
  const std::string& name = robot(child).name;
  const Robot& parent_robot = robot(parent);
  if (robot(child).mounting)
    fail("robot '{}' is already carried by '{}'", excerpt(name),
         excerpt(robot(robot(child).mounting->parent).name));
  if (link < 0 || link >= static_cast<int>(parent_robot.links.size()))
    fail("robot '{}': expected a link of '{}', 0 to {}, got {}", excerpt(name),
         excerpt(parent_robot.name), static_cast<int>(parent_robot.links.size()) - 1, link);
  check_place(
      X_LB, fmt::format("robot '{}': its pose on '{}'", excerpt(name), excerpt(parent_robot.name)));
  for (auto up = parent;;) {
    if (up == child)
      fail("robot '{}' cannot be carried by '{}', which it carries itself", excerpt(name),
           excerpt(parent_robot.name));
    if (!robot(up).mounting) break;
    up = robot(up).mounting->parent;
  }

  // the link, the adapter and the base are one rigid piece: they never collide
  const Id<Body> last = parent_robot.links[link].body;
  const Id<Body> base = robot(child).base;
  const Pose X_WB = pose(last) * X_LB;
  if (piece) {
    check_body(*piece, "mount");
    settings_->materials.index(piece->material);
  }
  place(child, X_WB);
  edit(child).mounting =
      Mounting{.parent = parent, .link = link, .X_LB = X_LB, .piece = std::nullopt};
  set_collision(false, last, base);
  if (piece) {
    BodySpec named = *piece;
    named.name = repaired_name(robot(child).name + "_mount");
    const auto body = add_body(named, BodyKind::mount, X_WB);
    edit(body).robot = child;
    edit(child).mounting->piece = body;
    set_collision(false, last, body);
    set_collision(false, base, body);
  }
}

void World::unmount(Id<Robot> child) {
  const std::optional<Mounting> mounting = robot(child).mounting;
  if (!mounting) fail("robot '{}' is not carried by another robot", excerpt(robot(child).name));
  // they were one rigid piece
  const Id<Body> last = robot(mounting->parent).links[mounting->link].body;
  set_collision(true, last, robot(child).base);
  if (mounting->piece) erase(*mounting->piece);
  edit(child).mounting.reset();
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

void World::remove(Id<Robot> id) {
  for (const auto body : bodies_of(id)) erase(body);
  for (const auto other : robots())
    if (robot(other).mounting && robot(other).mounting->parent == id) {
      // its adapter is removed with the arm to which it was attached
      if (const auto piece = robot(other).mounting->piece) erase(*piece);
      edit(other).mounting.reset();
    }
  WorldModel& model = edit_model();
  model.robots[id.index].used = false;
  model.robot_names.erase(model.robots[id.index].value.name);
  std::erase(model.robot_order, id);
  edit_settings().dynamics.robots.erase(id);
}

std::vector<Id<Body>> World::bodies_of(Id<Robot> id) const {
  const Robot& r = robot(id);
  std::vector<Id<Body>> out{r.base};
  for (const Link& link : r.links) out.push_back(link.body);
  if (r.mounting && r.mounting->piece) out.push_back(*r.mounting->piece);
  return out;
}

// --- properties of things ---

void World::set_eigengrasps(Id<Robot> id, std::shared_ptr<const EigengraspSet> set) {
  const Robot& r = robot(id);
  if (set) {
    const std::string subject = fmt::format("eigengrasps of robot '{}'", excerpt(r.name));
    if (set->dofs != static_cast<int>(r.dofs.size()))
      fail("{}: expected a set for {} DOFs, got one for {}", subject, r.dofs.size(), set->dofs);
    check_eigengrasps(*set, subject);
  }
  edit(id).eigengrasps = std::move(set);
}

void World::set_virtual_contacts(Id<Robot> id,
                                 std::shared_ptr<const std::vector<VirtualContactSpec>> contacts) {
  const Robot& r = robot(id);
  for (size_t i = 0; contacts && i < contacts->size(); ++i) {
    const VirtualContactSpec& c = (*contacts)[i];
    const std::string subject =
        fmt::format("virtual contact {} of robot '{}'", i + 1, excerpt(r.name));
    check_virtual_contact(c, subject);
    if (const int last = static_cast<int>(r.links.size()) - 1; c.link < -1 || c.link > last)
      fail("{}: expected a link from -1, the base, to {}, got {}", subject, last, c.link);
  }
  edit(id).virtual_contacts = std::move(contacts);
}

// --- properties ---

void World::add_friction(const OwnFriction& own) { edit_settings().materials.add(own); }

void World::set_material(Id<Body> id, std::string_view material) {
  edit(id).material = settings_->materials.index(material);
  edit(id).material_from = Origin::script;
}

void World::set_mass(Id<Body> id, double mass) {
  check(mass_rule, mass, the_body(body(id).name));
  edit(id).mass = mass;
  edit(id).mass_from = Origin::script;
}

void World::set_com(Id<Body> id, const Eigen::Vector3d& com) {
  check(coordinate_rule.called("com"), com, the_body(body(id).name));
  Body& b = edit(id);
  BodySpec spec;
  spec.shape = b.shape;
  spec.com = b.com;
  // an inertia that was computed from the shape is computed again about the new center
  const bool from_shape = b.inertia_per_mass == inertia_of(spec);
  b.com = spec.com.emplace(com);
  if (from_shape) b.inertia_per_mass = inertia_of(spec);
}

void World::set_inertia(Id<Body> id, const Eigen::Matrix3d& inertia) {
  const Body& b = body(id);
  const Eigen::Matrix3d per_mass = inertia / b.mass;
  check_inertia(per_mass, the_body(b.name));
  edit(id).inertia_per_mass = per_mass;
}

void World::set_elastic_modulus(Id<Body> id, std::optional<double> modulus) {
  if (modulus) check(elastic_modulus_rule, *modulus, the_body(body(id).name));
  edit(id).elastic_modulus = modulus;
}

void World::set_soft_layer(Id<Body> id, double height) {
  check(soft_layer_rule, height, the_body(body(id).name));
  edit(id).soft_layer = height;
}

void World::set_poisson_ratio(Id<Body> id, double ratio) {
  check(poisson_ratio_rule, ratio, the_body(body(id).name));
  edit(id).poisson_ratio = ratio;
}

void World::set_restitution(Id<Body> id, double ratio) {
  check(restitution_rule, ratio, the_body(body(id).name));
  edit(id).restitution = ratio;
}

static void check_resistance(double value, const char* name, const std::string& subject) {
  check(not_negative_rule.called(name), value, subject);
}

void World::set_free_damping(Id<Body> id, double damping) {
  check_resistance(damping, "free damping", the_body(body(id).name));
  edit(id).free_damping = damping;
}

void World::set_free_friction(Id<Body> id, double friction) {
  check_resistance(friction, "free friction", the_body(body(id).name));
  edit(id).free_friction = friction;
}

void World::set_free_armature(Id<Body> id, double armature) {
  check_resistance(armature, "free armature", the_body(body(id).name));
  edit(id).free_armature = armature;
}

void World::set_gravity_compensation(Id<Body> id, double part) {
  check(number_rule.called("gravity compensation"), part, the_body(body(id).name));
  edit(id).gravity_compensation = part;
}

void World::set_appearance(Id<Body> id, const Appearance& appearance) {
  check_appearance(appearance, the_body(body(id).name));
  edit(id).appearance = appearance;
}

void World::set_contact_threshold(double threshold) {
  check(contact_threshold_rule, threshold, "world");
  edit_settings().contact_threshold = threshold;
}

void World::set_camera(const std::optional<Camera>& camera) {
  if (camera) check_camera(*camera);
  edit_settings().camera = camera;
}

// --- time machine ---

std::shared_ptr<const Snapshot> World::snapshot() const {
  return std::make_shared<Snapshot>(Snapshot{lineage_, model_, settings_, state_});
}

void WorldState::make_room_for(const WorldState& other) {
  X_WB.reserve(other.X_WB.size());
  dofs.reserve(other.dofs.size());
  joints.reserve(other.joints.size());
  follows_dof.reserve(other.follows_dof.size());
}

void World::restore(const Snapshot& snapshot) {
  if (snapshot.lineage != lineage_)
    fail("world: the snapshot belongs to another world, of which this is no clone");
  // if memory runs out nothing has been changed yet
  state_.make_room_for(snapshot.state);
  // both are copied before they are changed
  model_ = std::const_pointer_cast<WorldModel>(snapshot.model);
  settings_ = std::const_pointer_cast<WorldSettings>(snapshot.settings);
  state_ = snapshot.state;
}

}  // namespace clench
