#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/model/fingerprint.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/named_list.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static int get_robot_bodies(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  push_bodies(L, robot.world, robot.world->bodies_of(robot.id));
  return set_finder(L, "world:body", body_class);
}

static std::vector<Id<Body>> links_of(const Robot& robot) {
  std::vector<Id<Body>> links;
  for (const Link& link : robot.links) links.push_back(link.body);
  return links;
}

static int get_robot_links(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  push_bodies(L, robot.world, links_of(*robot));
  return set_finder(L, "hand:link", body_class);
}

static int push_joint(lua_State* L, const RobotHandle& robot, int joint) {
  const Joint& spec = robot->joints[joint];
  const double q = robot.world->joints(robot.id)[joint];
  const bool left = !robot.world->follows_dof(robot.id, joint);
  const DofKind kind = robot->dofs[spec.dof].kind;
  push_record(L, {{"kind", spec.kind == JointKind::revolute ? "revolute" : "prismatic"},
                  {"dof", spec.dof + 1},
                  {"ratio", spec.ratio},
                  {"min", spec.min},
                  {"max", spec.max},
                  {"value", q},
                  {"broken_away", left && kind == DofKind::breakaway},
                  {"spring_deflection", spec.ratio * robot.world->dofs(robot.id)[spec.dof] - q}});
  if (!spec.name.empty()) set_field(L, "name", spec.name);
  if (spec.endless) set_field(L, "endless", true);
  if (spec.viscous > 0) set_field(L, "damping", spec.viscous);
  if (spec.coulomb > 0) set_field(L, "friction", spec.coulomb);
  if (spec.armature > 0) set_field(L, "armature", spec.armature);
  if (spec.spring > 0) set_field(L, "spring", spec.spring), set_field(L, "rest", spec.rest);
  if (spec.effort_range) set_field(L, "effort_range", *spec.effort_range);
  return 1;
}

static int get_chains(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_list_of(L, robot->chains, [&](const Chain& chain) {
    const Link& first = robot->links[chain.links.front()];
    const bool fixed = first.first_joint == first.end_joint;
    const auto push_joints = [&] {
      push_list_of(L, joints_of(*robot, chain), [&](int j) { push_joint(L, robot, j); });
    };
    std::vector<BodyHandle> links;
    for (const int l : chain.links) links.push_back({robot.world, robot->links[l].body});
    push_record(L, {{"pose", fixed ? first.X_JL : robot->joints[first.first_joint].X_PJ},
                    {"parent", BodyHandle{robot.world, robot->body_of(chain.parent)}},
                    {"links", links},
                    {"joints", push_joints}});
  });
}

static int get_approach(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Pose frame = robot.world->pose(robot->base) * robot->X_BA;
  return push_record(L, {{"point", frame.position},
                         {"direction", frame.rotation * Eigen::Vector3d::UnitZ()},
                         {"frame", frame}});
}

static std::optional<RobotHandle> carrier_of(const RobotHandle& robot) {
  if (!robot->mounting) return {};
  return RobotHandle{robot.world, robot->mounting->parent};
}

static int get_files(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  push_list(L, 0, 3);
  const RobotFiles& files = robot->files;
  const auto set = [&](const char* key, const std::string& path) {
    if (!path.empty()) set_field(L, key, std::string_view(path));
  };
  set("eigengrasps", files.eigengrasps);
  set("virtual_contacts", files.virtual_contacts);
  set("glove_calibration", files.glove_calibration);
  return 1;
}

// --- methods ---

static int link(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push(L, BodyHandle{robot.world, find_link(robot, check_string(L, 2, "name"), subject(L))});
}

static int robot_move_to(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_move(L, robot.world, move_robot(*robot.world, robot.id, check_pose(L, 2, "pose")));
}

static int approach_object(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 2);
  const double reach = options.number("reach", 1);
  options.done();
  return push_move(L, robot.world, approach(*robot.world, robot.id, reach));
}

static int place_approach(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Pose* frame = to<Pose>(L, 2);
  if (frame && given(L, 3))
    fail("{}: direction: not allowed with a pose, whose direction is +z", subject(L));
  const Eigen::Vector3d target = frame ? frame->position : check_vec3(L, 2, "target");
  const Pose X_WA = frame ? *frame : approach_frame(target, check_vec3(L, 3, "direction"));
  const double standoff = given(L, 4) ? check_number(L, 4, "standoff") : 0;
  suspect_millimeters(L, subject(L) + ": standoff", standoff);
  if (!frame) suspect_millimeters(L, subject(L) + ": target", target.cwiseAbs().maxCoeff());
  robot.world->set_pose(robot.id,
                        X_WA * Pose::translation({0, 0, -standoff}) * robot->X_BA.inverse());
  return 0;
}

static int mount_on(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto& parent = check_object<RobotHandle>(L, 2, "parent");
  if (parent.world != robot.world)
    fail("{}: '{}' belongs to another world", subject(L), parent->name);
  Table options(L, 3);
  const ReadOptions reading = read_options(L, options);
  const bool by_name = options.has("link");
  if (by_name && options.has("chain"))
    fail("{}: expected chain or link, got both", options.subject());
  const std::string link_name = options.string("link", "");
  const int chain = options.integer("chain", 1);
  const Pose pose = options.pose("pose", Pose{});
  const std::string adapter = options.string("adapter", "");
  options.done();
  if (!by_name && (chain < 1 || chain > static_cast<int>(parent->chains.size())))
    fail("{}: chain: expected 1 to {}, got {}", subject(L), parent->chains.size(), chain);
  const int link = by_name ? parent.world->body(find_link(parent, link_name, subject(L))).link
                           : parent->chains[chain - 1].links.back();
  if (link < 0) fail("{}: link: expected a link, got the base of '{}'", subject(L), parent->name);
  std::optional<BodySpec> spec;
  if (!adapter.empty()) spec = read_body(find_file(adapter, {}, reading), reading);
  robot.world->mount(robot.id, parent.id, link, pose, spec ? &*spec : nullptr);
  return 0;
}

static std::string robot_text(const RobotHandle& robot) {
  if (!robot.world->alive(robot.id)) return "removed robot";
  return fmt::format("robot '{}' of {} DOFs, {} chains, {} links", robot->name, robot->dofs.size(),
                     robot->chains.size(), robot->links.size());
}

static const Entry robot_fields[] = {
    {"fingerprint",
     getter<[](const RobotHandle& x) { return fingerprint_text(fingerprint(*x.world, x.id)); }>,
     R"(
Identity by content: equal for robots of the same links, joints, limits and motors, whatever their files, names, poses and postures.
@type string  16 hexadecimal digits
> copy = world:clone()
> hand.fingerprint == hand:in_world(copy).fingerprint  --> true)"},
    {"mechanism_fingerprint", getter<[](const RobotHandle& x) {
       ShapeFingerprints shapes;
       return fingerprint_text(mechanism_fingerprint(*x.world, x.id, shapes));
     }>,
     R"(
Fingerprint of everything that determines the poses in a posture: shapes, links, frames, axes and DOFs of joints. Masses, materials, limits and motors do not count, nor do
differences of frames below 1e-9 m. Grasps store it, and `grasp:apply` compares it.
@type string  16 hexadecimal digits
> hand.mechanism_fingerprint == grasp.hand_fingerprint  --> true)"},
    {"name", getter<[](const RobotHandle& x) { return x->name; }>, R"(
Name, unique in its world.
@type string
> world:robot(hand.name) == hand  --> true)"},
    {"pose", getter<[](const RobotHandle& robot) { return robot.world->pose(robot->base); }>, R"(
The pose of its base, in the world frame. Setting it moves the robot at once, with everything that it carries; see move_to.
@type pose
> hand.pose = {xyz = {0, 0, 1}}
> hand.base.pose.position  --> (0, 0, 1))",
     setter<[](const RobotHandle& x, const Pose& pose) { x.world->set_pose(x.id, pose); }>},
    {"links", guarded<get_robot_links>, R"(
Its links, chain by chain, without the base.
@type body[]
> #hand.links  --> 12)"},
    {"chains", guarded<get_chains>, R"(
Its chains: `parent`, the base or the link on which it begins; `pose` in the parent of its first joint, or of its link
if that is fixed; `links`; and `joints` with their present values (name, if its file names it, kind, dof, ratio, min, max,
value, broken_away: has it left a breakaway DOF?, spring_deflection: the value given by its DOF minus its own; spring [N
m/rad or N/m] and rest, the value at which it is slack, damping [N m s/rad or N s/m], friction [N m or N], effort_range of all actuators together [N m or N] and armature [kg
m^2 or kg], of joints that have them).
@type table[]
> #hand.chains  --> 4
> hand.chains[1].joints[1].kind  --> revolute)"},
    {"base", getter<[](const RobotHandle& robot) {
       return BodyHandle{robot.world, robot->base};
     }>,
     R"(
Its base: palm or stand.
@type body
> hand.base.kind  --> base)"},
    {"bodies", guarded<get_robot_bodies>, R"(
Base, links, and mount if it has one.
@type body[]
> #hand.bodies  --> 13)"},
    {"approach", guarded<get_approach>, R"(
Its approach to objects, in the world frame: `point`, on the palm or at the center of a
small object that it would hold; `direction`; `frame` with +z along it. From its file, or inferred, which `clench check` reports.
@type {point: vec3, direction: vec3, frame: pose}
> math.abs(hand.approach.direction:norm() - 1) < 1e-12  --> true)"},
    {"parent", getter<carrier_of>, R"(
The robot that carries it; nil if there is none.
@type robot?
> hand.parent  --> nil)"},
    {"class_name", getter<[](const RobotHandle& x) { return x->class_name; }>, R"(
Its kind, as its file names it.
@type string
> hand.class_name  --> Hand)"},
    {"source", getter<[](const RobotHandle& x) { return x->source; }>, R"(
File from which it was read.
@type string
> hand.source:match "%.cfg$"  --> .cfg)"},
    {"files", guarded<get_files>, R"(
Files named in its file: `eigengrasps`, `virtual_contacts`, `glove_calibration`.
@type table
> type(hand.files)  --> table)"},
};

// the robot with that id in a clone of its world
static int robot_in_world(lua_State* L) {
  const RobotHandle& robot = self<RobotHandle>(L);
  const WorldPtr world = check_object<WorldHandle>(L, 2, "world").world;
  if (!world->alive(robot.id) || world->robot(robot.id).name != robot->name)
    fail("{}: expected a clone of its world, got one without '{}' in its place", subject(L),
         excerpt(robot->name));
  return push_object(L, RobotHandle{world, robot.id});
}

static const Entry robot_methods[] = {
    {"in_world", guarded<robot_in_world>, R"(
The same robot in a clone of its world, or in the world of which its own is a clone.
@param world world  a clone of its world, or the world of which its own is a clone
@return robot
@effect reads
> copy = world:clone()
> hand:in_world(copy).world == copy, hand:in_world(copy) == hand  --> true, false)"},
    {"link", guarded<link>, R"(
A link, or the base, by its name, with or without the robot's.
@param name string  name of the link
@return body
@effect reads
> hand:link "chain0_link2" == hand.chains[1].links[3]  --> true
> hand:link "chain9_link0"  --> error: has no link)"},
    {"move_to", guarded<robot_move_to>, R"(
Moves the robot by its base until it first touches something, as a body's move_to.
@param pose pose  target pose of the base in the world
@return table result  `fraction`, `touched`, `stopped_by`, `iteration_limit`, `queries`
@effect edits
> hand:move_to(hand.pose).fraction  --> 1.0)"},
    {"approach_object", guarded<approach_object>, R"(
Moves the hand along its approach direction until it touches something.
@param options? table  how far
@option reach? number [m, >= 0] = 1  longest travel
@return table result  `fraction`, `touched`, `stopped_by`, `iteration_limit`, `queries`
@effect edits
> hand:approach_object{reach = -1}  --> error: reach)"},
    {"place_approach", guarded<place_approach>, R"(
Places the hand so that its approach point is in front of a target and its approach direction points there, without collision
checks. See `approach`.
@param target pose|vec3  of the approach frame, +z along the direction, or its point
@param direction? vec3  of approach, with a point: then the hand's turn about it follows from the world's x axis
@param standoff? number  how far before the target, 0 by default [m]
@effect edits
> hand:place_approach(flask.pose.position, {0, 0, -1}, 0.1)
> (hand.approach.point - flask.pose.position - clench.vec3(0, 0, 0.1)):norm() < 1e-12  --> true
> hand.approach.direction.z  --> -1.0)"},
    {"mount_on", guarded<mount_on>, R"(
Fixes the robot to a link of another one: to the named one, or the last of a chain. From then on it moves with that link.
@param parent robot  robot that carries this one
@param options? table  where, and by which adapter
@option chain? index = 1  chain whose last link carries it
@option link? string  name of another link that carries it
@option pose? pose  of the base in the link
@option adapter? string  file of a body between the link and the base
@like clench.load  root, confine, strict, unit, mesh_scale
@effect edits, files
> hand:mount_on(hand)  --> error: which it carries itself)"},
    {"dismount", method<[](const RobotHandle& x) { x.world->unmount(x.id); }>, R"(
Detaches the robot from the one that carries it: it keeps its pose, without its adapter.
@effect edits
> hand:dismount()  --> error: is not carried by another robot)"},
};

static const Entry robot_operators[] = {
    {"__tostring", method<robot_text>, ""},
    {"__eq", equality<RobotHandle>, ""},
};

const Class robot_class{
    .name = "robot",
    .variable = "hand",
    .doc = "A hand or an arm: a base, chains of links, and the degrees of freedom that move them.",
    .fields = robot_fields,
    .methods = robot_methods,
    .operators = robot_operators,
    .parent = &dofs_class};

}  // namespace clench
