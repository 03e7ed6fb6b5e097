#include "clench/model/world.h"

namespace clench {

// the size is included, so that vectors of different lengths differ
static void add(Hasher& h, const Eigen::Ref<const Eigen::VectorXd>& x) {
  h.add(static_cast<uint64_t>(x.size()));
  for (const double value : x) h.add(value);
}

static void add(Hasher& h, const EigengraspSet& set) {
  h.add(static_cast<uint64_t>(set.grasps.size()));
  for (const auto& grasp : set.grasps) {
    add(h, grasp.vector);
    h.add(grasp.eigenvalue);
    h.add_flag(grasp.limits.has_value());
    if (grasp.limits) h.add((*grasp.limits)[0]), h.add((*grasp.limits)[1]);
  }
  for (const auto* x : {&set.origin, &set.norm}) {
    h.add_flag(x->has_value());
    if (*x) add(h, **x);
  }
}

static void add(Hasher& h, const std::vector<VirtualContactSpec>& contacts) {
  h.add(static_cast<uint64_t>(contacts.size()));
  for (const auto& c : contacts) {
    h.add(static_cast<uint64_t>(c.link));
    add(h, c.X_LC);
    h.add(c.mu);
    add(h, c.edges.reshaped());
  }
}

static void add(Hasher& h, const DofControl& control) {
  h.add(static_cast<uint64_t>(control.mode));
  for (const double x : {control.target, control.velocity, control.effort}) h.add(x);
  h.add_flag(control.trajectory.has_value());
  if (const auto& t = control.trajectory)
    for (const double x : {t->from, t->to, t->begin, t->duration}) h.add(x);
}

static void add(Hasher& h, const Gains& gains) { h.add(gains.kp), h.add(gains.kd); }

// hash of the motion, without manifolds and warm starts; a world that never moved has the same hash
// as one at rest
static void add_motion(Hasher& h, const World& world) {
  const DynamicState* state = world.dynamics();
  const auto at = [](const auto& list, size_t i) {
    using Item = std::decay_t<decltype(list[0])>;
    return i < list.size() ? list[i] : Item{};
  };
  static const DynamicState rest;
  const DynamicState& s = state ? *state : rest;
  h.add(s.time);
  for (const auto id : world.bodies()) {
    for (const Twist& twist : {at(s.twists, id.index), at(s.solved, id.index)})
      add(h, twist.linear), add(h, twist.angular);
    const Load load = at(s.loads, id.index);
    add(h, load.force), add(h, load.torque);
  }
  for (const auto id : world.robots()) {
    const Robot& robot = world.robot(id);
    for (size_t i = robot.first_dof; i < robot.first_dof + robot.dofs.size(); ++i) {
      h.add(at(s.dof_velocities, i));
      add(h, world.control(id, static_cast<int>(i - robot.first_dof)));
    }
    for (size_t j = robot.first_joint; j < robot.first_joint + robot.joints.size(); ++j)
      h.add(at(s.joint_velocities, j));
  }
}

static void add(Hasher& h, const World& world, const DynamicSettings& settings) {
  h.add(settings.step);
  for (const int x :
       {static_cast<int>(settings.engine), static_cast<int>(settings.cone), settings.cone_edges})
    h.add(static_cast<uint64_t>(x));
  for (const auto id : world.robots()) {
    const RobotDynamics& robot = settings.robot(id);
    for (const bool on : {robot.floating, robot.gravity_compensation, robot.breakaway})
      h.add_flag(on);
    for (const auto& gains : robot.gains) {
      h.add_flag(gains.has_value());
      if (gains) add(h, *gains);
    }
    if (robot.max_effort) h.add(*robot.max_effort);
  }
  for (const auto& [id, velocity] : settings.surface_velocities)
    h.add(world.body(id).name), add(h, velocity);
  for (const auto& [object, to] : settings.welds)
    h.add(world.body(object).name), h.add(world.body(to).name);
}

static void add(Hasher& h, const World& world, Id<Body> id) {
  const Body& b = world.body(id);
  h.add(b.name);
  h.add(static_cast<uint64_t>(b.kind));
  add(h, world.pose(id));
  h.add(static_cast<uint64_t>(b.material));
  h.add(b.mass);
  for (const double x : b.com) h.add(x);
  for (const double x : b.inertia_per_mass.reshaped()) h.add(x);
  h.add(b.elastic_modulus.value_or(0));
  h.add(b.soft_layer);
  h.add(b.poisson_ratio);
  h.add(b.restitution);
  // defaults do not change the hash
  for (const double x : {b.free_damping, b.free_friction, b.free_armature, b.gravity_compensation})
    if (x != 0) h.add(x);
  h.add_flag(world.settings().switched_off.contains(id));
  h.add(b.shape ? b.shape->hash() : 0);
}

static void add(Hasher& h, const World& world, Id<Robot> id) {
  const Robot& r = world.robot(id);
  h.add(r.name);
  for (const double x : world.dofs(id)) h.add(x);
  for (const auto& range : r.limits) h.add(range[0]), h.add(range[1]);
  for (const bool endless : r.endless) h.add_flag(endless);
  add(h, r.X_BA);
  h.add_flag(r.eigengrasps != nullptr);
  if (r.eigengrasps) add(h, *r.eigengrasps);
  h.add_flag(r.virtual_contacts != nullptr);
  if (r.virtual_contacts) add(h, *r.virtual_contacts);
  h.add_flag(r.mounting.has_value());
  if (r.mounting) {
    h.add(world.robot(r.mounting->parent).name);
    h.add(static_cast<uint64_t>(r.mounting->link));
    add(h, r.mounting->X_LB);
  }
  for (const JointPosition& own : world.own_joint_positions(id))
    h.add_flag(own.has_value()), h.add(own.value_or(0));
}

static void add(Hasher& h, const MaterialTable& materials) {
  for (const auto& name : materials.names()) h.add(name);
  const int count = static_cast<int>(materials.names().size());
  for (int i = 0; i < count; ++i)
    for (int j = 0; j <= i; ++j) {
      const Friction f = materials.friction(i, j);
      h.add(f.statics), h.add(f.kinetic), h.add(f.restitution.value_or(-1));
    }
}

static void add_collision(Hasher& h, const World& world) {
  const WorldSettings& settings = world.settings();
  const auto add_pairs = [&](const std::set<BodyPair>& pairs) {
    for (const auto& [a, b] : pairs) h.add(world.body(a).name), h.add(world.body(b).name);
  };
  add_pairs(settings.pairs_off);
  // worlds without bits have the same hash as before bits existed
  for (const auto& [id, of] : settings.collision_bits) {
    h.add(world.body(id).name);
    h.add(uint64_t{of.first.type} << 32 | of.first.affinity);
    h.add_flag(of.first.stands);
  }
  add_pairs(settings.pairs_on);
}

static void add(Hasher& h, const World& world, const Keyframe& keyframe) {
  h.add(keyframe.name);
  for (const auto& placed : keyframe.bodies)
    if (world.alive(placed.body)) h.add(world.body(placed.body).name), add(h, placed.X_WB);
  for (const auto& placed : keyframe.robots) {
    if (!world.alive(placed.robot)) continue;
    h.add(world.robot(placed.robot).name);
    h.add_flag(placed.X_WB.has_value());
    if (placed.X_WB) add(h, *placed.X_WB);
    for (const double q : placed.dofs) h.add(q);
  }
}

uint64_t World::hash() const {
  Hasher h;
  for (const auto id : bodies()) add(h, *this, id);
  for (const auto id : robots()) add(h, *this, id);
  add(h, settings_->materials);
  add_collision(h, *this);
  h.add(settings_->contact_threshold);
  for (const double x : settings_->gravity) h.add(x);
  for (const Keyframe& keyframe : settings_->keyframes) add(h, *this, keyframe);
  h.add_flag(settings_->collision_on);
  add(h, *this, settings_->dynamics);
  add_motion(h, *this);
  return h.value();
}

}  // namespace clench
