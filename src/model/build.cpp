#include "clench/model/build.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/dof.h"

namespace clench {

// world files have six digits of a meter and of a radian
static constexpr double file_digits = 1e-5;

static Place robot_place(const std::string& name) {
  return Place("", 0, fmt::format("robot '{}'", excerpt(name)));
}

// within its limits a joint of a compliant DOF may have any position, and a joint has broken away
// if its breakaway DOF has moved on beyond it; any other follows its DOF
static std::vector<JointPosition> checked_joint_positions(const Robot& robot,
                                                          const Eigen::VectorXd& q,
                                                          const std::vector<JointPosition>& given,
                                                          const Diagnostics& diagnostics) {
  auto out = given;
  if (out.size() != robot.joints.size())
    fail("robot '{}': expected the states of {} joints, got {}", excerpt(robot.name),
         robot.joints.size(), out.size());
  for (size_t j = 0; j < out.size(); ++j) {
    if (!out[j]) continue;
    const Joint& joint = robot.joints[j];
    const bool sprung = robot.dofs[joint.dof].kind == DofKind::compliant;
    const bool beyond = sprung || (joint.ratio * q[joint.dof] - *out[j]) * joint.ratio > 0;
    const bool inside =
        joint.endless || (*out[j] >= joint.min - file_digits && *out[j] <= joint.max + file_digits);
    if (beyond && inside) continue;
    if (beyond)
      diagnostics.warn(robot_place(robot.name),
                       "joint {} of chain {} {} at {}, outside [{}, {}]; it follows its DOF",
                       number_in_chain(robot, static_cast<int>(j)) + 1,
                       place_of(robot.chains, joint.link).chain + 1,
                       sprung ? "stands" : "broke away", *out[j], joint.min, joint.max);
    out[j].reset();
  }
  return out;
}

static void set_start_dofs(World& world, Id<Robot> id, const PlacedRobot& placed,
                           const Diagnostics& diagnostics) {
  const Robot& robot = world.robot(id);
  if (placed.dofs.empty()) return;
  if (placed.dofs.size() != robot.dofs.size())
    fail("robot '{}': expected {} DOF values, got {}", excerpt(robot.name), robot.dofs.size(),
         placed.dofs.size());
  Eigen::VectorXd q(static_cast<Eigen::Index>(robot.dofs.size()));
  for (int i = 0; i < q.size(); ++i) {
    const auto [low, high] = range_around(robot, i, placed.dofs[i]);
    q[i] = std::clamp(placed.dofs[i], low, high);
    if (std::abs(q[i] - placed.dofs[i]) > file_digits)
      diagnostics.repaired(robot_place(robot.name),
                           "DOF {} starts at {}, outside [{}, {}]; moved to the limit", i + 1,
                           placed.dofs[i], low, high);
  }
  world.set_dofs(id, q);
  if (!placed.joint_positions.empty())
    world.set_dofs_unchecked(
        id, q, checked_joint_positions(robot, q, placed.joint_positions, diagnostics));
}

static void connect(World& world, const Connection& c, Id<Robot> parent, Id<Robot> child,
                    const Diagnostics& diagnostics) {
  const Robot& parent_robot = world.robot(parent);
  Pose X_LB = c.X_LB;
  if (c.link >= 0 && c.link < static_cast<int>(parent_robot.links.size())) {
    const Pose X_WL = world.pose(parent_robot.links[c.link].body);
    const Pose& X_WB = world.pose(world.robot(child).base);
    const Pose as_written = X_WL.inverse() * X_WB;
    const Pose off = X_LB.inverse() * as_written;
    if (off.position.norm() < file_digits && off.angle() < file_digits)
      // both as given if they agree bit-exactly
      X_LB = X_WL * X_LB == X_WB ? X_LB : as_written;
    else
      diagnostics.warn(robot_place(world.robot(child).name),
                       "its pose and its connection to '{}' differ by {:.3g} m and "
                       "{:.3g} rad; the connection is used",
                       excerpt(parent_robot.name), off.position.norm(), off.angle());
  }
  world.mount(child, parent, c.link, X_LB, c.mount ? &*c.mount : nullptr);
}

std::vector<BodyPair> switch_off_overlaps(World& world, Id<Robot> robot, double closer_than) {
  const auto own = world.bodies_of(robot);
  auto pairs = colliding_pairs(world, own, own, &world.context());
  for (size_t i = 0; closer_than > 0 && i < own.size(); ++i)
    for (size_t j = i + 1; j < own.size(); ++j) {
      const BodyPair pair{own[i], own[j]};
      if (!world.may_collide(own[i], own[j]) || std::ranges::find(pairs, pair) != pairs.end())
        continue;
      if (distance(world, std::span(&pair.first, 1), std::span(&pair.second, 1), closer_than,
                   &world.context())
              .a)
        pairs.push_back(pair);
    }
  for (const auto& [a, b] : pairs) world.set_collision(false, a, b);
  return pairs;
}

Id<Robot> add_robot(World& world, const RobotSpec& spec, const Pose& X_WB, const std::string& name,
                    const Diagnostics& diagnostics) {
  const auto id = world.add_robot(spec, X_WB, name);
  const bool near = spec.collision_rules.near_pairs_off;
  const auto pairs = switch_off_overlaps(world, id, near ? world.contact_threshold() : 0);
  if (!pairs.empty())
    diagnostics.note(
        robot_place(world.robot(id).name),
        "these of its bodies overlap{} when it is loaded, and never collide from now on: {}",
        near ? " or touch" : "", describe(world, pairs));
  return id;
}

namespace {

/// Builds the world of a spec, entry by entry.
class Builder {
 public:
  Builder(const WorldSpec& spec, const Diagnostics& diagnostics)
      : spec_(spec),
        diagnostics_(diagnostics),
        bodies_(spec.bodies.size()),
        robots_(spec.robots.size()),
        connected_(spec.connections.size()) {}
  World build();

 private:
  void add_robot(int index);
  void add_connection(int index);
  void switch_collision();
  void add_keyframe(const KeyframeSpec& spec);
  Id<Body> named(const std::string& name) const;
  Id<Body> part(const PartRef& ref) const;

  const WorldSpec& spec_;
  const Diagnostics& diagnostics_;
  World world_;
  std::vector<Id<Body>> bodies_;
  std::vector<Id<Robot>> robots_;
  std::vector<bool> connected_;
};

void Builder::add_robot(int index) {
  const PlacedRobot& placed = spec_.robots[index];
  // with all collisions off there is no need to search for overlaps
  robots_[index] = spec_.collision
                       ? world_.add_robot(placed.robot, placed.X_WB)
                       : clench::add_robot(world_, placed.robot, placed.X_WB, "", diagnostics_);
  set_start_dofs(world_, robots_[index], placed, diagnostics_);
  if (!placed.floating) return;
  DynamicSettings settings = world_.dynamic_settings();
  settings.robots[robots_[index]].floating = true;
  world_.set_dynamic_settings(std::move(settings));
}

void Builder::add_connection(int index) {
  const Connection& c = spec_.connections[index];
  const int count = static_cast<int>(robots_.size());
  if (c.parent < 0 || c.parent >= count || c.child < 0 || c.child >= count)
    fail("a connection names robots {} and {}, but the world has {}", c.parent, c.child, count);
  connect(world_, c, robots_[c.parent], robots_[c.child], diagnostics_);
  if (spec_.collision && c.mount)
    world_.set_name(*world_.robot(robots_[c.child]).mounting->piece, c.mount->name);
  connected_[index] = true;
}

Id<Body> Builder::named(const std::string& name) const {
  const auto id = world_.find_body(name);
  if (!id) fail("a collision switch names body '{}', but the world has none", excerpt(name));
  return id;
}

void Builder::switch_collision() {
  const auto neighbors = world_.pairs_off();
  for (const auto& [a, b] : neighbors) world_.set_collision(true, a, b);
  for (const auto& [a, b] : spec_.collision->pairs_off)
    world_.set_collision(false, named(a), named(b));
  for (const auto& [name, bits] : spec_.collision->bits)
    world_.set_collision_bits(named(name), bits);
  for (const auto& [a, b] : spec_.collision->pairs_on)
    world_.set_collision(true, named(a), named(b));
  for (const auto& name : spec_.collision->bodies_off) world_.set_collision(false, named(name));
  world_.set_collision(spec_.collision->on);
}

Id<Body> Builder::part(const PartRef& ref) const {
  return ref.kind == WorldEntry::Kind::body ? bodies_.at(ref.index)
                                            : world_.robot(robots_.at(ref.index)).body_of(ref.link);
}

void Builder::add_keyframe(const KeyframeSpec& spec) {
  Keyframe keyframe{spec.name, {}, {}};
  for (const auto& placed : spec.bodies)
    keyframe.bodies.push_back({bodies_.at(placed.body), placed.X_WB});
  for (const auto& placed : spec.robots)
    keyframe.robots.push_back({robots_.at(placed.robot), placed.X_WB, placed.dofs});
  world_.add_keyframe(std::move(keyframe));
}

World Builder::build() {
  if (spec_.contact_threshold) world_.set_contact_threshold(*spec_.contact_threshold);
  for (const FrictionSpec& f : spec_.friction)
    world_.set_friction(f.a, f.b, {f.statics, f.kinetic, f.restitution});
  for (const OwnFriction& f : spec_.frictions) world_.add_friction(f);
  for (const WorldEntry& entry : spec_.order) {
    if (entry.kind == WorldEntry::Kind::body) {
      const PlacedBody& placed = spec_.bodies[entry.index];
      bodies_[entry.index] = world_.add_body(
          placed.body, placed.role == Role::object ? BodyKind::object : BodyKind::obstacle,
          placed.X_WB);
    } else if (entry.kind == WorldEntry::Kind::robot) {
      add_robot(entry.index);
    } else {
      add_connection(entry.index);
    }
  }
  for (size_t i = 0; i < connected_.size(); ++i)
    if (!connected_[i]) add_connection(static_cast<int>(i));
  if (spec_.collision) switch_collision();
  for (const auto& [a, b] : spec_.never_meet) world_.set_collision(false, part(a), part(b));
  for (const auto& [ref, bits] : spec_.collision_bits) world_.set_collision_bits(part(ref), bits);
  for (const auto& [a, b] : spec_.always_meet) world_.set_collision(true, part(a), part(b));
  if (!spec_.collision_on) world_.set_collision(false);
  if (spec_.gravity) world_.set_gravity(*spec_.gravity);
  if (spec_.time_step) {
    DynamicSettings settings = world_.dynamic_settings();
    settings.step = *spec_.time_step;
    world_.set_dynamic_settings(std::move(settings));
  }
  for (const KeyframeSpec& keyframe : spec_.keyframes) add_keyframe(keyframe);
  world_.set_camera(spec_.camera);
  world_.set_source(spec_.source);
  return std::move(world_);
}

}  // namespace

World build_world(const WorldSpec& spec, const Diagnostics& diagnostics) {
  return Builder(spec, diagnostics).build();
}

}  // namespace clench
