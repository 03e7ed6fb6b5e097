#include "clench/model/describe_world.h"

#include <algorithm>
#include <map>

namespace clench {

namespace {

class Describer {
 public:
  explicit Describer(const World& world) : world_(world) {}
  WorldSpec describe();

 private:
  BodySpec body(Id<Body> id) const;
  RobotSpec robot(const Robot& r) const;
  PlacedRobot placed(Id<Robot> id) const;
  int number(Id<Robot> id) const;
  void add_body(Id<Body> id);
  void add_connections(Id<Robot> robot);
  void add_connection(Id<Robot> child);
  void add_friction();
  void add_collision();
  void add_keyframes();

  const World& world_;
  WorldSpec out_;
  std::map<Id<Body>, int> body_numbers_;  // in out_.bodies
};

BodySpec Describer::body(Id<Body> id) const {
  const Body& b = world_.body(id);
  BodySpec out;
  out.name = b.name;
  out.source = b.source;
  out.file = b.file;
  out.shape = b.shape;
  out.mesh_report = b.mesh_report;
  out.appearance = b.appearance;
  out.material = world_.materials().name(b.material);
  out.mass = b.mass;
  out.material_from = b.material_from;
  out.mass_from = b.mass_from;
  out.com = b.com;
  out.inertia_per_mass = b.inertia_per_mass;
  out.elastic_modulus = b.elastic_modulus;
  out.soft_layer = b.soft_layer;
  out.poisson_ratio = b.poisson_ratio;
  out.restitution = b.restitution;
  out.free_damping = b.free_damping;
  out.free_friction = b.free_friction;
  out.free_armature = b.free_armature;
  out.gravity_compensation = b.gravity_compensation;
  out.tracker = b.tracker;
  return out;
}

RobotSpec Describer::robot(const Robot& r) const {
  RobotSpec out;
  out.name = r.name;
  out.source = r.source;
  out.file = r.file;
  out.class_name = r.class_name;
  out.base = body(r.base);
  out.dofs = r.dofs;
  for (const Link& from : r.links) {
    LinkSpec link{.body = body(from.body), .parent = from.parent, .X_JL = from.X_JL};
    link.joints.assign(r.joints.begin() + from.first_joint, r.joints.begin() + from.end_joint);
    out.links.push_back(std::move(link));
  }
  out.X_BA = r.X_BA;
  if (r.eigengrasps) out.eigengrasps = *r.eigengrasps;
  if (r.virtual_contacts) out.virtual_contacts = *r.virtual_contacts;
  if (r.glove) out.glove = *r.glove;
  out.files = r.files;
  out.tracker = r.tracker;
  out.joint_tendons = r.joint_tendons;
  if (r.passive) {
    out.tactile = r.passive->tactile;
    out.tendons = r.passive->tendons;
    out.wrappers = r.passive->wrappers;
    out.actuators = r.passive->actuators;
  }
  return out;
}

PlacedRobot Describer::placed(Id<Robot> id) const {
  const Robot& r = world_.robot(id);
  PlacedRobot out;
  out.robot = robot(r);
  out.X_WB = world_.pose(r.base);
  const auto q = world_.dofs(id);
  out.dofs.assign(q.begin(), q.end());
  out.joint_positions = world_.own_joint_positions(id);
  out.floating = world_.dynamic_settings().robot(id).floating;
  return out;
}

int Describer::number(Id<Robot> id) const {
  const auto& robots = world_.robots();
  return static_cast<int>(std::find(robots.begin(), robots.end(), id) - robots.begin());
}

void Describer::add_connection(Id<Robot> child) {
  const Mounting& mounting = *world_.robot(child).mounting;
  Connection c;
  c.parent = number(mounting.parent);
  c.link = mounting.link;
  c.child = number(child);
  c.X_LB = mounting.X_LB;
  if (mounting.piece) c.mount = body(*mounting.piece);
  out_.order.push_back({WorldEntry::Kind::connection, static_cast<int>(out_.connections.size())});
  out_.connections.push_back(std::move(c));
}

/// Connections without an adapter, whose order is invisible, as soon as both robots exist.
void Describer::add_connections(Id<Robot> robot) {
  for (const auto child : world_.robots()) {
    const auto& mounting = world_.robot(child).mounting;
    if (!mounting || mounting->piece) continue;
    if (std::max(number(child), number(mounting->parent)) == number(robot)) add_connection(child);
  }
}

void Describer::add_body(Id<Body> id) {
  const Body& b = world_.body(id);
  if (b.kind == BodyKind::object || b.kind == BodyKind::obstacle) {
    out_.order.push_back({WorldEntry::Kind::body, static_cast<int>(out_.bodies.size())});
    const Role role = b.kind == BodyKind::object ? Role::object : Role::obstacle;
    body_numbers_[id] = static_cast<int>(out_.bodies.size());
    out_.bodies.push_back({body(id), role, world_.pose(id)});
  } else if (b.kind == BodyKind::base) {
    out_.order.push_back({WorldEntry::Kind::robot, number(b.robot)});
    add_connections(b.robot);
  } else if (b.kind == BodyKind::mount) {
    add_connection(b.robot);
  }
}

void Describer::add_friction() {
  const MaterialTable& table = world_.materials();
  const MaterialTable standard;
  const int count = static_cast<int>(table.names().size());
  const int known = static_cast<int>(standard.names().size());
  const auto add = [&](int a, int b) {
    const Friction f = table.friction(a, b);
    out_.friction.push_back({table.name(a), table.name(b), f.statics, f.kinetic, f.restitution});
  };
  // new names first, each paired with itself, so that they keep their order
  for (int i = known; i < count; ++i) add(i, i);
  for (int i = 0; i < count; ++i)
    for (int j = 0; j <= i; ++j) {
      const Friction f = table.friction(i, j);
      const Friction usual = i < known ? standard.friction(i, j) : Friction{};
      if (i >= known && i == j) continue;
      if (f.statics != usual.statics || f.kinetic != usual.kinetic ||
          f.restitution != usual.restitution)
        add(i, j);
    }
}

void Describer::add_collision() {
  const WorldSettings& set = world_.settings();
  CollisionSpec spec;
  spec.on = set.collision_on;
  for (const auto id : set.switched_off) spec.bodies_off.push_back(world_.body(id).name);
  const auto names = [&](const BodyPair& pair) {
    return std::array{world_.body(pair.first).name, world_.body(pair.second).name};
  };
  for (const BodyPair& pair : set.pairs_off) spec.pairs_off.push_back(names(pair));
  for (const auto& [id, of] : set.collision_bits)
    spec.bits.emplace_back(world_.body(id).name, of.first);
  for (const BodyPair& pair : set.pairs_on) spec.pairs_on.push_back(names(pair));
  out_.collision = std::move(spec);
}

/// Removed bodies are in no keyframe.
void Describer::add_keyframes() {
  for (const Keyframe& keyframe : world_.keyframes()) {
    KeyframeSpec spec{keyframe.name, {}, {}};
    for (const auto& placed : keyframe.bodies)
      if (const auto found = body_numbers_.find(placed.body); found != body_numbers_.end())
        spec.bodies.push_back({found->second, placed.X_WB});
    for (const auto& placed : keyframe.robots)
      if (world_.alive(placed.robot))
        spec.robots.push_back({number(placed.robot), placed.X_WB, placed.dofs});
    out_.keyframes.push_back(std::move(spec));
  }
}

WorldSpec Describer::describe() {
  out_.source = world_.source();
  for (const auto id : world_.robots()) out_.robots.push_back(placed(id));
  for (const auto id : world_.bodies()) add_body(id);
  out_.camera = world_.camera();
  out_.contact_threshold = world_.contact_threshold();
  out_.gravity = world_.gravity();
  add_keyframes();
  add_friction();
  if (const double step = world_.dynamic_settings().step; step != DynamicSettings{}.step)
    out_.time_step = step;
  add_collision();
  return std::move(out_);
}

}  // namespace

WorldSpec describe_world(const World& world) { return Describer(world).describe(); }

}  // namespace clench
