#include <algorithm>

#include "clench/base/convert.h"
#include "clench/base/suggest.h"
#include "clench/motion/drive.h"
#include "clench/script/bind/bind.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static int set_pose(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  robot.world->set_pose(robot.id, check_pose(L, 2));
  return 0;
}

static int get_bodies(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_bodies(L, robot.world, robot.world->bodies_of(robot.id));
}

static std::vector<Id<Body>> links_of(const Robot& robot) {
  std::vector<Id<Body>> links;
  for (const Link& link : robot.links) links.push_back(link.body);
  return links;
}

static int get_links(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_bodies(L, robot.world, links_of(*robot));
}

static void push_joint(lua_State* L, const RobotHandle& robot, int joint) {
  const Joint& spec = robot->joints[joint];
  const double q = robot.world->joints(robot.id)[joint];
  push_list(L, 0, 11);
  if (!spec.name.empty()) set_field(L, "name", std::string_view(spec.name));
  set_field(L, "kind", spec.kind == JointKind::revolute ? "revolute" : "prismatic");
  set_field(L, "dof", spec.dof + 1);
  set_field(L, "ratio", spec.ratio);
  set_field(L, "min", spec.min);
  set_field(L, "max", spec.max);
  set_field(L, "value", q);
  const bool left = !robot.world->follows_dof(robot.id, joint);
  const DofKind kind = robot->dofs[spec.dof].kind;
  set_field(L, "broken_away", left && kind == DofKind::breakaway);
  set_field(L, "spring_deflection", spec.ratio * robot.world->dofs(robot.id)[spec.dof] - q);
  if (spec.spring > 0) set_field(L, "spring", spec.spring), set_field(L, "rest", spec.rest);
}

// numbers of a chain's joints
static std::vector<int> joints_of(const Robot& robot, const Chain& chain) {
  std::vector<int> out;
  for (const int l : chain.links)
    for (int j = robot.links[l].first_joint; j < robot.links[l].end_joint; ++j) out.push_back(j);
  return out;
}

static int get_chains(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_list_of(L, robot->chains, [&](const Chain& chain) {
    push_list(L, 0, 4);
    const Link& first = robot->links[chain.links.front()];
    const bool fixed = first.first_joint == first.end_joint;
    set_field(L, "pose", fixed ? first.X_JL : robot->joints[first.first_joint].X_PJ);
    push(L, BodyHandle{robot.world, robot->body_of(chain.parent)});
    lua_setfield(L, -2, "parent");
    std::vector<Id<Body>> links;
    for (const int l : chain.links) links.push_back(robot->links[l].body);
    push_bodies(L, robot.world, links);
    lua_setfield(L, -2, "links");
    push_list_of(L, joints_of(*robot, chain), [&](int j) { push_joint(L, robot, j); });
    lua_setfield(L, -2, "joints");
  });
}

static int get_dofs(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_vector(L, robot.world->dofs(robot.id));
}

// DOF values of an argument; a wrong count names the robot
static Eigen::VectorXd check_dofs(lua_State* L, int i, const Robot& robot) {
  const auto values = read_numbers(L, i, {L, {}, "values"});
  if (values.size() != robot.dofs.size())
    fail("{}: robot '{}': expected {} DOF values, got {}", subject(L), robot.name,
         robot.dofs.size(), values.size());
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<int>(values.size()));
}

// rows {chain, joint, value} of joints that do not follow their DOFs
static std::vector<JointPosition> check_joint_positions(Table& options, const Robot& robot) {
  std::vector<JointPosition> out(robot.joints.size());
  for (const auto& row : options.rows("joint_positions", 3)) {
    const auto number = [&](double x, size_t count, const char* what) {
      if (!(x >= 1 && x <= static_cast<double>(count) && x == std::floor(x)))
        fail("{}: joint_positions: expected a {} from 1 to {}, got {}", options.subject(), what,
             count, x);
      return floor_between(x, size_t{1}, count) - 1;
    };
    const size_t c = number(row[0], robot.chains.size(), "chain");
    const auto joints = joints_of(robot, robot.chains[c]);
    const size_t j = number(row[1], joints.size(), "joint");
    const Joint& joint = robot.joints[joints[j]];
    if (!(row[2] >= joint.min - 1e-9 && row[2] <= joint.max + 1e-9))
      fail("{}: joint_positions: joint {} of chain {}: expected a value in [{}, {}], got {}",
           options.subject(), j + 1, c + 1, joint.min, joint.max, row[2]);
    out[joints[j]] = row[2];
  }
  return out;
}

static int set_dofs(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Eigen::VectorXd values = check_dofs(L, 2, *robot);
  Table options(L, 3);
  std::vector<JointPosition> own;
  if (options.has("joint_positions")) own = check_joint_positions(options, *robot);
  options.done();
  robot.world->set_dofs(robot.id, values);
  if (!own.empty()) {
    const Eigen::VectorXd q = robot.world->dofs(robot.id);
    robot.world->set_dofs_unchecked(robot.id, q, own);
  }
  return 0;
}

static int get_dof_limits(lua_State* L) {
  return push_list_of(L, self<RobotHandle>(L)->limits,
                      [&](const std::array<double, 2>& range) { push_numbers(L, range); });
}

static int get_dof_names(lua_State* L) {
  int number = 0;
  return push_list_of(L, self<RobotHandle>(L)->dofs, [&](const DofSpec& dof) {
    ++number;
    push(L, dof.name.empty() ? fmt::format("dof{}", number) : dof.name);
  });
}

static const char* dof_kind(DofKind kind) {
  static constexpr const char* names[] = {"rigid", "breakaway", "compliant"};
  return names[static_cast<int>(kind)];
}

static int get_dof_info(lua_State* L) {
  return push_list_of(L, self<RobotHandle>(L)->dofs, [&](const DofSpec& dof) {
    push_list(L, 0, 8);
    if (!dof.name.empty()) set_field(L, "name", std::string_view(dof.name));
    set_field(L, "kind", dof_kind(dof.kind));
    set_field(L, "default_velocity", dof.default_velocity);
    set_field(L, "max_effort", dof.max_effort);
    if (dof.max_velocity > 0) set_field(L, "max_velocity", dof.max_velocity);
    set_field(L, "kp", dof.kp);
    set_field(L, "kd", dof.kd);
    set_field(L, "breakaway_torque", dof.breakaway_torque);
  });
}

static int get_approach(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Pose frame = robot.world->pose(robot->base) * robot->X_BA;
  push_list(L, 0, 3);
  set_field(L, "point", frame.position);
  set_field(L, "direction", Eigen::Vector3d(frame.rotation * Eigen::Vector3d::UnitZ()));
  set_field(L, "frame", frame);
  return 1;
}

static int get_parent(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  if (robot->mounting) return push(L, RobotHandle{robot.world, robot->mounting->parent});
  lua_pushnil(L);
  return 1;
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

// --- verbs ---

static Id<Body> find_link(lua_State* L, const RobotHandle& robot, const std::string& name) {
  std::vector<std::string> names;
  auto parts = links_of(*robot);
  parts.push_back(robot->base);
  for (const auto id : parts) {
    const std::string& full = robot.world->body(id).name;
    if (full == name || full == robot->name + "_" + name) return id;
    names.push_back(full);
  }
  fail("{}: robot '{}' has no link '{}'{}", subject(L), robot->name, name,
       did_you_mean(name, names));
}

static int link(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push(L, BodyHandle{robot.world, find_link(L, robot, check_string(L, 2, "name"))});
}

static const char* stop_name(DofStop stop) {
  static constexpr const char* names[] = {"reached", "limit", "contact", "not_driven",
                                          "iteration_limit"};
  return names[static_cast<int>(stop)];
}

int push_drive(lua_State* L, const WorldPtr& world, const DriveResult& result) {
  push_list(L, 0, 5);
  set_field(L, "moved", result.moved);
  push_list_of(L, result.stops, [&](DofStop stop) { push(L, stop_name(stop)); });
  lua_setfield(L, -2, "stops");
  push_pairs(L, world, result.stopped_by);
  lua_setfield(L, -2, "stopped_by");
  set_field(L, "queries", result.queries);
  set_field(L, "events", result.events);
  return 1;
}

static int autograsp(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 2);
  const double speed = options.number("speed", 1);
  const DriveOptions driving{.stop_at_contact = options.boolean("stop_at_contact", false)};
  options.done();
  return push_drive(L, robot.world, clench::autograsp(*robot.world, robot.id, speed, driving));
}

static int open(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 2);
  options.done();
  return push_drive(L, robot.world, open_hand(*robot.world, robot.id));
}

static int move_dofs(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const Eigen::VectorXd targets = check_dofs(L, 2, *robot);
  Table options(L, 3);
  const DriveOptions driving{.stop_at_contact = options.boolean("stop_at_contact", false)};
  options.done();
  return push_drive(L, robot.world, drive_to(*robot.world, robot.id, targets, driving));
}

static int move_to(lua_State* L) {
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
  if (frame && given(L, 3)) fail("{}: direction: a pose has its own, +z", subject(L));
  const Pose X_WA =
      frame ? *frame : approach_frame(check_vec3(L, 2, "target"), check_vec3(L, 3, "direction"));
  const double standoff = given(L, 4) ? check_number(L, 4, "standoff") : 0;
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
  const int link = by_name ? parent.world->body(find_link(L, parent, link_name)).link
                           : parent->chains[chain - 1].links.back();
  if (link < 0) fail("{}: link: expected a link, got the base of '{}'", subject(L), parent->name);
  std::optional<BodySpec> spec;
  if (!adapter.empty()) spec = read_body(find_file(adapter, {}, reading), reading);
  robot.world->mount(robot.id, parent.id, link, pose, spec ? &*spec : nullptr);
  return 0;
}

static int text(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  if (!robot.world->alive(robot.id)) return push(L, "removed robot");
  return push(L, fmt::format("robot '{}' of {} DOFs, {} chains, {} links", robot->name,
                             robot->dofs.size(), robot->chains.size(), links_of(*robot).size()));
}

static int equal(lua_State* L) {
  const auto *a = to<RobotHandle>(L, 1), *b = to<RobotHandle>(L, 2);
  return push(L, a && b && a->world == b->world && a->id == b->id);
}

static const Entry fields[] = {
    {"name", getter<[](const RobotHandle& x) { return x->name; }>, R"(
Unique in its world.
@type string
> world:robot(hand.name) == hand  --> true)"},
    {"pose", getter<[](const RobotHandle& robot) { return robot.world->pose(robot->base); }>, R"(
Where its base is, in the world frame. Setting it moves the robot at once, with all that it carries; see move_to.
@type pose
> hand.pose = {xyz = {0, 0, 1}}
> hand.base.pose.position  --> (0, 0, 1))",
     guarded<set_pose>},
    {"dofs", guarded<get_dofs>, R"(
Values of its degrees of freedom; a list of its own, set as by set_dofs.
@type number[]  [rad or m]
> #hand.dofs  --> 12)",
     guarded<set_dofs>},
    {"dof_limits", guarded<get_dof_limits>, R"(
Least and largest value of each DOF.
@type number[][]  [rad or m]
> #hand.dof_limits[1]  --> 2)"},
    {"dof_info", guarded<get_dof_info>, R"(
What its file says of each DOF: name, where it has one, kind ("rigid", "breakaway", "compliant"), default_velocity
of closing [rad/s or m/s], max_effort [N m or N], max_velocity, where known, kp, kd, breakaway_torque [N m].
@type table[]
> hand.dof_info[1].kind  --> rigid)"},
    {"dof_names", guarded<get_dof_names>, R"(
Names of its DOFs, as its file calls them; "dof1" and so on where it does not.
@type string[]
> hand.dof_names[1]  --> dof1)"},
    {"links", guarded<get_links>, R"(
Its links, chain by chain, without the base.
@type body[]
> #hand.links  --> 12)"},
    {"chains", guarded<get_chains>, R"(
Its chains: `parent`, the base or the link that it begins on; `pose` in the parent of its first joint, or of its link
where that is fixed, `links`, and `joints` as they stand (name, where its file names it, kind, dof, ratio, min, max,
value, broken_away: did it leave a breakaway DOF?, spring_deflection: how far its DOF has gone on without it; spring [N
m/rad or N/m] and rest, the value where it is slack, of joints that have one).
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
    {"bodies", guarded<get_bodies>, R"(
Base, links, and mount if it has one.
@type body[]
> #hand.bodies  --> 13)"},
    {"approach", guarded<get_approach>, R"(
How it approaches what it grasps, in the world frame: `point` on the palm, `direction`, `frame` with +z along it.
@type {point: vec3, direction: vec3, frame: pose}
> math.abs(hand.approach.direction:norm() - 1) < 1e-12  --> true)"},
    {"parent", guarded<get_parent>, R"(
The robot that carries it; nil when none does.
@type robot?
> hand.parent  --> nil)"},
    {"class_name", getter<[](const RobotHandle& x) { return x->class_name; }>, R"(
What its file calls its kind.
@type string
> hand.class_name  --> Hand)"},
    {"source", getter<[](const RobotHandle& x) { return x->source; }>, R"(
File that it was read from.
@type string
> hand.source:match "%.cfg$"  --> .cfg)"},
    {"files", guarded<get_files>, R"(
Files that its file names: `eigengrasps`, `virtual_contacts`, `glove_calibration`.
@type table
> type(hand.files)  --> table)"},
};

static const Entry methods[] = {
    {"link", guarded<link>, R"(
A link, or the base, by its name, whole or without the robot's.
@param name string
@return body
> hand:link "chain0_link2" == hand.chains[1].links[3]  --> true
> hand:link "chain9_link0"  --> error: has no link)"},
    {"set_dofs", guarded<set_dofs>, R"(
Sets all DOFs at once, whatever is in the way; see move_dofs. Joints that had broken away, or were held against their
springs, follow again, but for those that the options name by chain, joint and the value at which they stand [rad or m].
@param values number[]  within the limits [rad or m]
@param options? {joint_positions?: number[][]}  rows {chain, joint, value}
> hand:set_dofs{1, 2, 3}  --> error: expected 12 DOF values, got 3)"},
    {"move_dofs", guarded<move_dofs>, R"(
Drives all DOFs in proportion towards values, until contact stops them.
@param values number[]  within the limits [rad or m]
@param options? {stop_at_contact?: boolean}  true: end at the first new contact of any link
@return table result  as of autograsp
> hand:move_dofs(hand.dofs).moved  --> false)"},
    {"autograsp", guarded<autograsp>, R"(
Closes the hand: each DOF goes to its limit in the sense of its default velocity until contact stops it. Breakaway
fingers go on beyond the joint that is stopped. The joints of compliant DOFs follow the balance of springs, contacts
and friction: the tendon pulls on, and they yield and slide, until contacts take any further pull. Negative speed
opens.
@param options? {speed?: number, stop_at_contact?: boolean}
@return table result  `moved`, `stops` (one per DOF: "contact", "limit", "reached", "not_driven", "iteration_limit"), `stopped_by` (pairs), `queries`, `events`
> hand:autograsp().moved  --> false
> hand:autograsp{sped = 1}  --> error: did you mean 'speed'?)"},
    {"open", guarded<open>, R"(
Opens the hand as far as it goes. One that overlaps something is opened regardless of contacts until it is free.
@param options? table  no options yet
@return table result  as of autograsp
> hand:open().moved  --> true
> #world:contacts(hand, flask)  --> 0)"},
    {"move_to", guarded<move_to>, R"(
Moves the whole robot until it first touches something, as a body's move_to.
@param pose pose
@return table result  `fraction`, `touched`, `stopped_by`, `iteration_limit`, `queries`
> hand:move_to(hand.pose).fraction  --> 1.0)"},
    {"approach_object", guarded<approach_object>, R"(
Moves the hand along its approach direction until it touches something.
@param options? {reach?: number}  at most this far, 1 by default [m]
@return table result  `fraction`, `touched`, `stopped_by`, `iteration_limit`, `queries`
> hand:approach_object{reach = -1}  --> error: reach)"},
    {"place_approach", guarded<place_approach>, R"(
Places the hand so that its approach point stands before a target and its approach direction leads there, whatever is in
the way. See `approach`.
@param target pose|vec3  of the approach frame, +z along the direction, or its point
@param direction? vec3  of approach, with a point: then the hand's turn about it follows from the world's x axis
@param standoff? number  how far before the target, 0 by default [m]
> hand:place_approach(flask.pose.position, {0, 0, -1}, 0.1)
> (hand.approach.point - flask.pose.position - clench.vec3(0, 0, 0.1)):norm() < 1e-12  --> true
> hand.approach.direction.z  --> -1.0)"},
    {"mount_on", guarded<mount_on>, R"(
Fixes the robot to a link of another one: that of a name, or the last of a chain. It follows from now on.
@param parent robot
@param options? {chain?: integer, link?: string, pose?: pose, adapter?: string, root?: string, confine?: string, strict?: boolean}  chain 1 by default; pose of the base in the link; file of an adapter
> hand:mount_on(hand)  --> error: which it carries itself)"},
};

static const Entry operators[] = {
    {"__tostring", guarded<text>, ""},
    {"__eq", guarded<equal>, ""},
};

const Class robot_class{.name = "robot",
                        .variable = "hand",
                        .doc =
                            "A hand or an arm: a base, chains of links, and "
                            "the degrees of freedom that move them.",
                        .fields = fields,
                        .methods = methods,
                        .operators = operators,
                        .parent = &hand_class};

}  // namespace clench
