#include <algorithm>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/watched.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/picture/pictures.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/spec/plausibility.h"

namespace clench {

// --- collision filters ---

static int set_collision(lua_State* L) {
  const auto& world = self<WorldHandle>(L).world;
  const bool on = check_boolean(L, 2, "on");
  if (!given(L, 3)) {
    world->set_collision(on);
    return 0;
  }
  const auto group_a = check_bodies(L, 3, "a", world);
  if (!given(L, 4)) {
    for (const auto a : group_a) world->set_collision(on, a);
    return 0;
  }
  const auto group_b = check_bodies(L, 4, "b", world);
  for (const auto a : group_a)
    for (const auto b : group_b)
      if (a != b) world->set_collision(on, a, b);
  return 0;
}

// bodies of the argument, or all bodies of the world without one
static std::vector<Id<Body>> bodies_or_all(lua_State* L, int index, const char* name,
                                           const WorldPtr& world) {
  return given(L, index) ? check_bodies(L, index, name, world) : world->bodies();
}

static int may_collide(lua_State* L) {
  const auto& world = self<WorldHandle>(L).world;
  const auto group_a = bodies_or_all(L, 2, "a", world), group_b = bodies_or_all(L, 3, "b", world);
  for (const auto a : group_a) {
    check_stop();
    for (const auto b : group_b)
      if (world->may_collide(a, b)) return push(L, true);
  }
  return push(L, false);
}

static int set_collision_bits(lua_State* L) {
  const auto& world = self<WorldHandle>(L).world;
  const auto bodies = check_bodies(L, 2, "entity", world);
  Table options(L, 3);
  CollisionBits bits;
  bits.type = static_cast<unsigned>(options.integer("type", 1));
  bits.affinity = static_cast<unsigned>(options.integer("affinity", 1));
  bits.stands = options.boolean("fixed", false);
  options.done();
  for (const auto body : bodies) world->set_collision_bits(body, bits);
  return 0;
}

// --- friction ---

// a misspelt name would create a new material; numbered ones are intended
static void tell_near_material(lua_State* L, const std::string& name) {
  static const char told = 0;
  const std::vector<std::string>& known = world_of(L).materials().names();
  if (std::ranges::find(known, name) != known.end() ||
      name.find_first_of("0123456789") != std::string::npos)
    return;
  const std::string near = did_you_mean(name, known);
  if (!near.empty())
    warn_once(L, &told,
              fmt::format("{}: {} is a new material{}", subject(L), in_quotes(name), near));
}

static int set_friction(lua_State* L) {
  const std::string a = check_string(L, 2, "material");
  if (lua_type(L, 3) == LUA_TNUMBER && !given(L, 4))
    fail("{}: expected a pair of materials and their friction, got one material, {}", subject(L),
         in_quotes(a));
  const std::string b = check_string(L, 3, "material");
  if (lua_type(L, 4) == LUA_TNUMBER) {
    const double mu = check_number(L, 4, "friction");
    for (const std::string& name : {a, b}) tell_near_material(L, name);
    world_of(L).set_friction(a, b, {.statics = mu, .kinetic = mu});
    return 0;
  }
  Table options(L, 4);
  const double statics = options.number("static");
  Friction friction{.statics = statics,
                    .kinetic = options.number("kinetic", std::max(0.0, statics - 0.1))};
  if (options.has("restitution")) friction.restitution = options.number("restitution");
  options.done();
  for (const std::string& name : {a, b}) tell_near_material(L, name);
  world_of(L).set_friction(a, b, friction);
  return 0;
}

static int friction(lua_State* L) {
  const MaterialTable& table = world_of(L).materials();
  const Friction f = table.friction(table.index(check_string(L, 2, "material")),
                                    table.index(check_string(L, 3, "material")));
  push(L, f.statics);
  push(L, f.kinetic);
  if (f.restitution) push(L, *f.restitution);
  return f.restitution ? 3 : 2;
}

// --- gravity ---

static int set_gravity(lua_State* L) {
  world_of(L).set_gravity(check_vec3(L, 2, "gravity"));
  static const char told = 0;
  if (const std::string doubt = doubt_gravity(world_of(L).gravity()); !doubt.empty())
    warn_once(L, &told, doubt);
  return 0;
}

// --- named states ---

static std::vector<std::string> keyframe_names(const WorldHandle& x) {
  std::vector<std::string> names;
  for (const Keyframe& keyframe : x.world->keyframes()) names.push_back(keyframe.name);
  return names;
}

static int set_keyframe(lua_State* L) {
  world_of(L).set_keyframe(check_string(L, 2, "name"));
  return 0;
}

// reads state i of a list from its table on top of the stack
static void read_state(lua_State* L, int i, const WorldPtr& world, Keyframe& into) {
  const std::string what = fmt::format("{}: state {}", subject(L), i);
  if (!lua_istable(L, -1)) fail("{}: expected a table, got {}", what, described(L, -1));
  Table values(L, lua_gettop(L), what);
  const bool of_robot = values.has("robot");
  values.push(of_robot ? "robot" : "body");
  const auto* body = to<BodyHandle>(L, -1);
  const auto* robot = to<RobotHandle>(L, -1);
  if (of_robot ? !robot : !body)
    fail("{}: expected body = a body or robot = a robot, got {}", what, described(L, -1));
  if ((of_robot ? robot->world : body->world) != world)
    fail("{}: it belongs to another world", what);
  const Id<Body> body_id = of_robot ? Id<Body>{} : body->id;
  const Id<Robot> robot_id = of_robot ? robot->id : Id<Robot>{};
  lua_pop(L, 1);
  if (of_robot) {
    std::optional<Pose> X_WB;
    if (values.has("pose")) X_WB = values.pose("pose", Pose{});
    if (values.push("dofs") == LUA_TNIL) fail("{}: dofs: expected their values, got none", what);
    const Eigen::VectorXd q =
        read_dofs(L, lua_gettop(L), values.what("dofs"), RobotHandle{world, robot_id});
    lua_pop(L, 1);
    into.robots.push_back({robot_id, X_WB, {q.begin(), q.end()}});
  } else {
    into.bodies.push_back({body_id, values.pose("pose", Pose{})});
  }
  values.done();
}

static int add_keyframe(lua_State* L) {
  const WorldPtr& world = self<WorldHandle>(L).world;
  const std::string name = check_string(L, 2, "name");
  if (!given(L, 3)) {
    world->add_keyframe(world->current_keyframe(name));
    return 0;
  }
  if (!lua_istable(L, 3))
    fail("{}: expected a list of states, got {}", subject(L), described(L, 3));
  Keyframe keyframe{name, {}, {}};
  const int count = static_cast<int>(lua_rawlen(L, 3));
  if (count == 0) {
    lua_pushnil(L);
    if (lua_next(L, 3))
      fail("{}: expected a list of states, as in {{{{robot = hand, dofs = hand.dofs}}}}, got {}",
           subject(L), described(L, 3));
  }
  for (int i = 1; i <= count; ++i) {
    lua_rawgeti(L, 3, i);
    read_state(L, i, world, keyframe);
    lua_pop(L, 1);
  }
  world->add_keyframe(std::move(keyframe));
  return 0;
}

// --- tables ---

static const Entry world_settings_fields[] = {
    {"contact_threshold", getter<[](const WorldHandle& x) { return x.world->contact_threshold(); }>,
     R"(
Surfaces closer than this are in contact; motion stops with a gap below it.
@type number  [m]
> world.contact_threshold  --> 0.0001)",
     setter<[](const WorldHandle& x, double threshold) {
       x.world->set_contact_threshold(threshold);
     }>},
    {"materials", getter<[](const WorldHandle& x) { return x.world->materials().names(); }>, R"(
Names of the materials, beginning with the seven of GraspIt!.
@type string[]
> world.materials[1]  --> frictionless)"},
    {"camera", guarded<get_camera>, R"(
The camera of its file, as `clench.render` takes it: `clench.render(world, world.camera)`. nil when the file has none.
Set it to such a table, or to one with `pose` (the camera looks along -z, y up) and `focal_distance` [m].
@type {eye: vec3, target: vec3, up: vec3, field_of_view: number}?
> clench.world().camera  --> nil
> world.camera = {eye = {1, 0, 0.5}, target = {0, 0, 0}, up = {0, 0, 1}}
> world.camera.eye  --> (1, 0, 0.5)
> world.camera = {eye = {0, 0, 1}, target = {0, 0, 0}, up = {0, 0, 1}}  --> error: up in another direction than the view)",
     guarded<set_camera>},
    {"gravity", getter<[](const WorldHandle& x) { return x.world->gravity(); }>, R"(
Gravitational acceleration of joints and objects, in the world frame.
@type vec3  [m/s^2]
> world.gravity  --> (0, 0, -9.81)
> world.gravity = {0, 0, -1.62}
> world.gravity.z  --> -1.62
> world.gravity = {0, 0, 1e9}  --> error: gravity: expected a number from -1e+06 to 1e+06 [m/s^2])",
     guarded<set_gravity>},
    {"keyframes", getter<keyframe_names>, R"(
Names of its saved states, those of its file first; `set_keyframe` restores them.
@type string[]
> #world.keyframes  --> 0)"},
};

static const Entry world_settings_methods[] = {
    {"set_collision", guarded<set_collision>, R"(
Switches collision on or off: for the whole world, for one entity against everything, or for a pair.
@param on boolean  true: collisions count; false: they are ignored
@param a? body|robot  one of two; without both, the setting is for all
@param b? body|robot  the other of two; without it, all pairs of the first
@effect edits
> world:set_collision(false, hand, flask)
> #world:contacts(hand, flask)  --> 0)"},
    {"may_collide", guarded<may_collide>, R"(
Is collision enabled for a pair, for one entity with anything, or for anything in the world? False for pairs that `set_collision` or `set_collision_bits` has
switched off, and for neighbors of a robot.
@param a? body|robot  one of two; without both, any pair counts
@param b? body|robot  the other of two; without it, any body
@return boolean
@effect reads
> world:may_collide(hand, flask)  --> true
> world:set_collision(false, hand, flask)
> world:may_collide(hand, flask), world:may_collide()  --> false, true)"},
    {"set_collision_bits", guarded<set_collision_bits>, R"(
Sets the collision bits of bodies, like `contype` and `conaffinity` of MuJoCo: two bodies with bits, not of one robot, collide if the type of one and the
affinity of the other share a bit. Fixed bodies do not collide with each other. A later `world:set_collision(true, a, b)` makes a pair
collide with any bits.
@param entity body|robot  body or robot to set
@param bits? table  the bits
@option type? integer = 1  bits of this kind of body
@option affinity? integer = 1  bits of the kinds that it collides with
@option fixed? boolean = false  true: it is fixed to the world
@effect edits
> world:set_collision_bits(flask, {type = 2, affinity = 2})
> world:set_collision_bits(hand, {type = 4})
> #world:contacts(hand, flask)  --> 0)"},
    {"set_friction", guarded<set_friction>, R"(
Sets the Coulomb coefficients of a pair of materials; new names become materials.
@param a string  name of a material
@param b string  name of the other material, or of the same
@param friction number|table  one coefficient for both, or a table of these options
@option static number [0 to 1e6]  static coefficient
@option kinetic? number [0 to 1e6]  kinetic coefficient, by default static - 0.1, at least 0
@option restitution? number [0 to 1]  speed after an impact by that before, instead of that of the bodies
@effect edits
> world:set_friction("cork", "wood", {static = 0.7})
> world:set_friction("cork", "cork", 0.6)
> world:friction("wood", "cork")  --> 0.7, 0.6
> world:set_friction("wood", 0.5)  --> error: expected a pair of materials)"},
    {"friction", guarded<friction>, R"(
The coefficients of a pair of materials.
@param a string  name of a material
@param b string  name of the other material, or of the same
@return number static
@return number kinetic
@return number? restitution  where the pair has one of its own
@effect reads
> world:friction("rubber", "stone")  --> 1.5, 1.4)"},
    {"add_keyframe", guarded<add_keyframe>, R"(
Stores the present state, or one given by a list, under a name. It replaces a keyframe of the same name.
@param name string  name of the keyframe
@param states? table[]  {body = body, pose = pose} and {robot = robot, pose = pose?, dofs = number[], or some by name}; what is not listed stays where it is; DOFs that are not named get the values that they have now
@effect edits
> world:add_keyframe "closed"
> world:add_keyframe("away", {{body = flask, pose = {xyz = {9, 0, 0}}}})
> world.keyframes[2]  --> away
> world:add_keyframe("bent", {{robot = hand, dofs = {dof2 = 0.1}}})
> world:add_keyframe("away", {{robot = hand, dofs = {1}}})  --> error: expected 12 DOF values, got 1
> world:add_keyframe("away", {{body = 1}})  --> error: state 1: expected body = a body or robot = a robot, got 1
> world:add_keyframe("away", {1})  --> error: state 1: expected a table, got 1
> world:add_keyframe("away", {robot = hand, dofs = hand.dofs})  --> error: expected a list of states)"},
    {"set_keyframe", guarded<set_keyframe>, R"(
Restores the poses and postures of a keyframe, without collision checks. Removed bodies stay removed, and a
robot that is carried stays on its carrier.
@param name string  name of the keyframe
@effect edits
> world:add_keyframe "closed"
> hand:open()
> world:set_keyframe "closed"
> world:contacts(hand, flask)[1] ~= nil  --> true
> world:set_keyframe "clsed"  --> error: no keyframe 'clsed' in this world, expected one of closed)"},
};

const Class world_settings_class{
    .name = "world_settings",
    .variable = "world",
    .doc =
        "Settings of a world: friction of materials, collision filters, "
        "gravity, its camera, its named states.",
    .fields = world_settings_fields,
    .methods = world_settings_methods};

}  // namespace clench
