// Robots of a world: adding, mounting and removing them.
#include <algorithm>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/world.h"
#include "clench/spec/check_robot.h"

namespace clench {

Id<Robot> World::add_robot(const RobotSpec& spec, Pose X_WB, const std::string& name) {
  check_robot(spec);
  check_name(name, "robot");
  check_place(X_WB, fmt::format("robot '{}'", excerpt(spec.name)));
  check_name_is_free(name);
  Robot robot = make_robot(spec);
  robot.name = name.empty() ? unique_name(spec.name) : name;
  add_start_state(robot);

  // the robot first, so that its parts refer to it
  const size_t count = bodies().size();
  const auto id = insert(std::move(robot));
  std::optional<MaterialTable> materials;
  if (!spec.frictions.empty()) materials = settings_->materials;
  try {
    for (const OwnFriction& friction : spec.frictions) add_friction(friction);
    add_parts(id, spec, X_WB);
    place(id, X_WB);
  } catch (const Error&) {
    if (materials) edit_settings().materials = std::move(*materials);
    while (bodies().size() > count) erase(bodies().back());
    erase(id);
    throw;
  }
  return id;
}

Id<Robot> World::insert(Robot robot) {
  Id<Robot>& named = edit_model().robot_names[robot.name];
  const auto id = insert_slot(model_->robots, std::move(robot), next_serial());
  model_->robot_order.push_back(id);
  named = id;
  return id;
}

// entries of the state for a new robot: its DOFs have their default values, and joints follow them
void World::add_start_state(Robot& robot) {
  robot.first_dof = state_.dofs.size();
  robot.first_joint = state_.joints.size();
  for (size_t i = 0; i < robot.dofs.size(); ++i) {
    const auto [low, high] = robot.limits[i];
    const double start = robot.dofs[i].default_value;
    state_.dofs.push_back(robot.endless[i] ? start : std::clamp(start, low, high));
  }
  for (const Joint& joint : robot.joints) {
    state_.joints.push_back(joint.ratio * state_.dofs[robot.first_dof + joint.dof]);
    state_.follows_dof.push_back(true);
  }
}

// a part's name follows its robot's if that had to be changed
static std::string part_name(const std::string& part, const std::string& was,
                             const std::string& is) {
  return part.starts_with(was) ? is + part.substr(was.size()) : part;
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

void World::remove(Id<Robot> id) {
  for (const auto body : bodies_of(id)) erase(body);
  for (const auto other : robots())
    if (robot(other).mounting && robot(other).mounting->parent == id) {
      // its adapter is removed with the arm to which it was attached
      if (const auto piece = robot(other).mounting->piece) erase(*piece);
      edit(other).mounting.reset();
    }
  erase(id);
  edit_settings().dynamics.robots.erase(id);
}

void World::erase(Id<Robot> id) {
  WorldModel& model = edit_model();
  model.robots[id.index].used = false;
  model.robot_names.erase(model.robots[id.index].value.name);
  std::erase(model.robot_order, id);
}

std::vector<Id<Body>> World::bodies_of(Id<Robot> id) const {
  const Robot& r = robot(id);
  std::vector<Id<Body>> out{r.base};
  for (const Link& link : r.links) out.push_back(link.body);
  if (r.mounting && r.mounting->piece) out.push_back(*r.mounting->piece);
  return out;
}

// --- properties ---

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

}  // namespace clench
