#include <array>

#include "clench/base/suggest.h"
#include "clench/model/build.h"
#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/named_list.h"
#include "clench/script/bind/read_spec.h"
#include "clench/script/bind/world/world_files.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/spec/assumed.h"
#include "clench/spec/plausibility.h"

namespace clench {

// --- construction ---

static int new_world(lua_State* L) {
  Table options(L, 1);
  const auto world = std::make_shared<World>();
  world->set_contact_threshold(options.number("contact_threshold", world->contact_threshold()));
  world->set_gravity(options.vec3("gravity", world->gravity()));
  static const char told = 0;
  if (const std::string doubt = doubt_gravity(world->gravity()); !doubt.empty())
    warn_once(L, &told, subject(L) + ": " + doubt);
  world->set_dynamic_settings(read_dynamic_settings(options));
  options.done();
  return push_world(L, world);
}

static int add_body(lua_State* L, BodyKind kind) {
  const auto& handle = self<WorldHandle>(L);
  Table options(L, 3);
  const ReadOptions reading = read_options(L, options);
  const BodySpec spec = check_body_spec(L, 2, options, reading);
  const std::string file = std::filesystem::path(spec.file).filename().string();
  const Place place = file.empty() ? Place("", 0, subject(L)).of("mesh") : Place(file);
  // no notes: a script knows which values it omits
  const Diagnostics told = file.empty() ? reading.diagnostics.without_notes() : reading.diagnostics;
  if (const std::string doubt =
          options.has("elastic_modulus") ? doubt_modulus(*spec.elastic_modulus) : "";
      !doubt.empty())
    told.suspected(place, "elastic_modulus {}", doubt);
  if (kind == BodyKind::object) {
    check_plausible_object(spec, place, reading.diagnostics);
    tell_assumed(std::array{&spec}, place, told);
  } else {
    tell_assumed({}, place, told, std::array{&spec});
  }
  const Pose pose = options.pose("pose", Pose{});
  const bool named = options.has("name");
  options.done();
  const auto id = handle.world->add_body(spec, kind, pose, named ? spec.name : "");
  add_owned_bodies(L, 1, std::array{id});
  return push(L, BodyHandle{handle.world, id});
}

static int add_object(lua_State* L) { return add_body(L, BodyKind::object); }
static int add_obstacle(lua_State* L) { return add_body(L, BodyKind::obstacle); }

static int add_robot(lua_State* L) {
  const auto& handle = self<WorldHandle>(L);
  const std::string path = check_string(L, 2, "path");
  Table options(L, 3);
  ReadOptions reading = read_options(L, options);
  read_robot_options(L, options, reading);
  const Pose pose = options.pose("pose", Pose{});
  const std::string name = options.string("name", "");
  options.done();
  const RobotSpec spec = read_robot(find_file(path, {}, reading), reading);
  const auto id = clench::add_robot(*handle.world, spec, pose, name, reading.diagnostics);
  add_owned_bodies(L, 1, handle.world->bodies_of(id));
  return push(L, RobotHandle{handle.world, id});
}

static int remove(lua_State* L) {
  const auto& handle = self<WorldHandle>(L);
  check_bodies(L, 2, "entity", handle.world);  // of this world, and alive
  if (const auto* robot = to<RobotHandle>(L, 2))
    handle.world->remove(robot->id);
  else
    handle.world->remove(to<BodyHandle>(L, 2)->id);
  return 0;
}

// --- finding ---

static int get_world_bodies(lua_State* L) {
  const auto& handle = self<WorldHandle>(L);
  push_bodies(L, handle.world, handle.world->bodies());
  return set_finder(L, "world:body", body_class);
}

static int push_kind(lua_State* L, BodyKind kind) {
  const auto& handle = self<WorldHandle>(L);
  std::vector<Id<Body>> ids;
  for (const auto id : handle.world->bodies())
    if (handle.world->body(id).kind == kind) ids.push_back(id);
  push_bodies(L, handle.world, ids);
  return set_finder(L, "world:body", body_class);
}

static int get_objects(lua_State* L) { return push_kind(L, BodyKind::object); }
static int get_obstacles(lua_State* L) { return push_kind(L, BodyKind::obstacle); }

static int get_robots(lua_State* L) {
  const auto& handle = self<WorldHandle>(L);
  push_list_of(L, handle.world->robots(), [&](auto id) { push(L, RobotHandle{handle.world, id}); });
  return set_finder(L, "world:robot", robot_class);
}

// the result of `find` for a name, or an error that lists all names
template <class Handle, class Thing>
static int push_found(lua_State* L, const char* kind,
                      Id<Thing> (World::*find)(std::string_view) const,
                      const std::vector<Id<Thing>>& all) {
  const auto& handle = self<WorldHandle>(L);
  const std::string name = check_string(L, 2, "name");
  if (const auto id = (*handle.world.*find)(name)) return push(L, Handle{handle.world, id});
  std::vector<std::string> names;
  for (const auto id : all) names.push_back(Handle { handle.world, id } -> name);
  fail("{}: no {} '{}' in this world{}", subject(L), kind, name, instead_of(name, names));
}

static int body(lua_State* L) {
  return push_found<BodyHandle>(L, "body", &World::find_body, world_of(L).bodies());
}

static int robot(lua_State* L) {
  return push_found<RobotHandle>(L, "robot", &World::find_robot, world_of(L).robots());
}

// --- saved states ---

static int clone(lua_State* L) { return push_world(L, std::make_shared<World>(world_of(L))); }

// bodies and robots removed since then are restored with their old handles
static int become(lua_State* L) {
  const WorldPtr& world = self<WorldHandle>(L).world;
  const WorldPtr other = check_object<WorldHandle>(L, 2, "clone").world;
  if (!world->is_related(*other))
    fail("{}: expected a clone of the world, or of one of its clones, got another world",
         subject(L));
  *world = World(*other);
  return 0;
}

static int restore(lua_State* L) {
  const auto& handle = self<WorldHandle>(L);
  handle.world->restore(*check_object<SnapshotHandle>(L, 2, "snapshot").moment);
  return 0;
}

static std::string world_text(const WorldHandle& x) {
  const auto several = [](size_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
  };
  return fmt::format("world of {}, {}", several(x.world->bodies().size(), "body", "bodies"),
                     several(x.world->robots().size(), "robot", "robots"));
}

static std::string snapshot_text(const SnapshotHandle& x) {
  return fmt::format("snapshot of {} bodies", x.moment->model->body_order.size());
}

// --- tables ---

static const Entry world_functions[] = {
    {"world", guarded<new_world>, R"(
An empty world.
@param options? table  settings of the empty world
@option contact_threshold? number [m, 1e-9 to 0.01] = 1e-4  surfaces closer than this touch
@option gravity? vec3 [m/s^2] = {0, 0, -9.81}  gravitational acceleration
@option dynamics? table  as of world.dynamics
@option dynamics.time_step? number [s, 1e-7 to 1] = 0.001  length of a step
@option dynamics.engine? "clench"|"ode" = "clench"  library that solves the contacts
@option dynamics.cone? "round"|"pyramid" = "round"  friction cones
@option dynamics.edges? integer [4 to 64] = 8  of pyramids, an even number
@return world
@effect reads
> #clench.world().bodies  --> 0)"},
    {"load", guarded<load_world>, R"(
A world from a file. Names in it are looked up next to the file, then below the root. A .lua file is run with two
arguments, a table with the `root` and the folder of the file, and returns a world. With `confine`, here and wherever
files are read, only files below that folder are read, after resolving links, and no .lua file is run.
A scene of MuJoCo is converted: every tree of joints becomes a robot, free bodies objects, fixed bodies obstacles. For the file
of a robot or a body, the result is a world with only that robot or body.
@param path string  .wld, .xml, .lua or .mjcf; or any file of a robot or a body
@param options? table  how the file is read
@option root? string  folder in which names in files are looked up after the folder of the file
@option confine? string  folder outside of which no file is read, by default that of --confine
@option strict? boolean = false  true: warnings are errors
@option keyframe? string  saved state to begin with
@option unit? "mm"|"cm"|"m"|"inch"|"foot"  of the coordinates in files of meshes; by default what the file states, else a guess, which is logged
@option mesh_scale? number [m, 1e-12 to 1e12]  length of that unit, instead of `unit`
@option folder? string  another folder in which names in the file of a robot are looked up
@option body? string  of a scene of MuJoCo: body with which the robot's tree of joints begins
@option package? string|table  folder of the packages of a URDF, or folders by name
@option eigengrasps? string  file to read instead of that which the robot's file names
@option virtual_contacts? string  file to read instead of that which the robot's file names
@option close? table  directions in which DOFs close, {index_1 = 1, thumb = -1, [3] = 0}
@option approach? table  approach of the hand in its base: `point` and `direction`, or `frame`
@option approach.point? vec3 [m] = {0, 0, 0}  approach point
@option approach.direction? vec3  approach direction
@option approach.frame? pose  z along the direction
@return world
@effect files
> #clench.load("worlds/dlr_flask.wld", {root = "."}).robots  --> 1
> #clench.load("models/objects/flask.iv", {root = "."}).objects  --> 1
> clench.load("models/objects/flask.iv", {root = ".", keyframe = "home"})  --> error: no keyframe 'home' in this world, which has none
> clench.load("no/such.wld")  --> error: no/such.wld)"},
};

static const Entry world_fields[] = {
    {"bodies", guarded<get_world_bodies>, R"(
All bodies in creation order: objects, obstacles, robot bases, links, mounts.
@type body[]
> world.bodies[1] ~= nil  --> true)"},
    {"objects", guarded<get_objects>, R"(
The bodies that can be grasped.
@type body[]
> world.objects[1] == flask  --> true)"},
    {"obstacles", guarded<get_obstacles>, R"(
The bodies that serve only as obstacles.
@type body[]
> #world.obstacles  --> 0)"},
    {"robots", guarded<get_robots>, R"(
All robots in creation order.
@type robot[]
> world.robots[1] == hand  --> true)"},
    {"source", getter<[](const WorldHandle& x) { return x.world->source(); }>, R"(
File from which the world was loaded; empty if a script made it.
@type string
> clench.world().source == ""  --> true)"},
};

static const Entry world_methods[] = {
    {"body", guarded<body>, R"(
The body with a name.
@param name string  name of the body
@return body
@effect reads
> world:body(flask.name) == flask  --> true
> world:body "no such thing"  --> error: no body)"},
    {"robot", guarded<robot>, R"(
The robot with a name.
@param name string  name of the robot
@return robot
@effect reads
> world:robot(hand.name) == hand  --> true
> world:robot "no such thing"  --> error: no robot)"},
    {"add_object", guarded<add_object>, R"(
Adds a body that can be grasped: from a file, or from a mesh of vertices and triangles in meters. Values in the
options override the file.
@param body string|mesh|table  file name (.iv .wrl .xml .obj .stl .ply .off .gltf .glb .dae), or {vertices = {{x, y, z}, ...}, triangles = {{i, j, k}, ...}}
@param options? table  the body, and how it is read
@option pose? pose  in the world
@option name? string  name of the body, by default that of the file
@option material? string  name of its material
@option mass? number [kg, 1e-12 to 1e12]  by default that of the file
@option density? number [kg/m^3, 1e-12 to 1e12]  of a watertight mesh, instead of the mass
@option com? vec3 [m]  center of mass
@option inertia? number[][] [kg m^2]  3 rows of 3
@option elastic_modulus? number [Pa, 1e-3 to 1e15]  of a soft body
@option soft_layer? number [m, 1e-9 to 1e9]  thickness of the soft layer
@option poisson_ratio? number [0 to 0.499999]  of the soft layer
@option restitution? number [0 to 1]  speed after an impact by that before
@option free_damping? number [>= 0]  damping of its motion, as a free joint has it
@option free_friction? number [>= 0]  friction of its motion, as a free joint has it
@option free_armature? number [>= 0]  inertia that is added to its own, as a free joint has it
@option gravity_compensation? number  part of its weight that is compensated
@option color? number[]  red, green and blue, 0 to 1
@option transparency? number [0 to 1]  0: opaque
@like clench.load  root, confine, strict, unit, mesh_scale
@return body
@effect edits, files
> world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {name = "cube", mass = 0.2}).mass  --> 0.2
> math.abs(world:add_object(clench.shapes.box {0.1, 0.1, 0.1}, {density = 1000}).mass - 1) < 1e-12  --> true
> world:add_object "flsk.iv"  --> error: flsk.iv)"},
    {"add_obstacle", guarded<add_obstacle>, R"(
Adds a body that serves only as an obstacle; options as for add_object.
@param body string|mesh|table  file name, mesh, or vertices and triangles, as world:add_object takes them
@param options? table  the body, and how it is read
@like world:add_object
@return body
@effect edits, files
> world:add_obstacle(clench.shapes.box {1, 1, 0.1}, {pose = {xyz = {0, 0, -2}}}).kind  --> obstacle)"},
    {"add_robot", guarded<add_robot>, R"(
Adds a robot from a file.
@param path string  .cfg .xml .urdf .mjcf
@param options? table  the robot, and how it is read
@option pose? pose  of its base, in the world
@option name? string  name of the robot, by default that of the file
@like clench.load  root, confine, strict, unit, mesh_scale, folder, body, package, eigengrasps, virtual_contacts, close, approach
@return robot
@effect edits, files
> world:add_robot("nothing.cfg")  --> error: nothing.cfg)"},
    {"remove", guarded<remove>, R"(
Removes an object, an obstacle or a complete robot. Using it afterwards is an error that names it.
@param entity body|robot  body or robot to remove
@effect edits
> world:remove(flask)
> flask.pose  --> error: was removed)"},
    {"clone", guarded<clone>, R"(
An independent copy that shares the meshes. Its bodies and robots are found by name, or by their places in its lists.
@return world
@effect reads
> copy = world:clone()
> copy == world  --> false
> copy:hash() == world:hash()  --> true)"},
    {"become", guarded<become>, R"(
Copies everything from a clone of the world: state, bodies, robots and settings. Bodies and robots removed since the clone was made are restored with their old handles.
@param clone world  clone of this world whose state is taken
@effect edits
> before = world:clone()
> world:remove(flask)
> world:become(before)
> flask.world == world, world:hash() == before:hash()  --> true, true
> world:become(clench.world())  --> error: expected a clone of the world, or of one of its clones, got another world)"},
    {"snapshot", method<[](const WorldHandle& x) { return SnapshotHandle{x.world->snapshot()}; }>,
     R"(
The present state of the world, bit-exactly.
@return snapshot
@effect reads
> world:snapshot() ~= nil  --> true)"},
    {"restore", guarded<restore>, R"(
Restores a snapshot of this world, of a clone of it, or of its original: bodies removed since then are
restored, those added since then are removed.
@param snapshot snapshot  result of world:snapshot
@effect edits
> before, moment = world:hash(), world:snapshot()
> hand:open()
> world:restore(moment)
> world:hash() == before  --> true)"},
    {"save", guarded<save_world>, R"(
Writes the world: as .xml or .mjcf a scene of MuJoCo, its meshes in a folder next to it, and its present state as the reference posture
and as the key "start"; as .wld, or as .xml with the format "graspit", for GraspIt!; as a .lua script that stores everything. The old file
is kept until the new one has been read back; a warning names everything that the format cannot represent.
@param path string  .xml, .mjcf, .wld or .lua
@param options? table  how it is written
@option format? "mjcf"|"graspit"  of an .xml file; by default mjcf, unless a robot carries another one, because such a scene has one robot when it is read
@option root? string  folder from which names of files below it are written
@option confine? string  folder outside of which no file is read or written, by default that of --confine
@effect files
> path = os.tmpname()
> world:save(path .. ".lua")
> clench.load(path .. ".lua"):hash() == world:hash()  --> true
> os.remove(path)
> os.remove(path .. ".lua")
> world:save "world.txt"  --> error: expected the extension .xml, .mjcf, .wld or .lua, got '.txt'
> world:save("world.xml", {format = "usd"})  --> error: unknown format 'usd')"},
    {"hash", method<[](const WorldHandle& x) { return fmt::format("{:016x}", x.world->hash()); }>,
     R"(
Fingerprint of the state: equal for bit-identical states.
@return string  16 hexadecimal digits
@effect reads
> #world:hash()  --> 16)"},
};

static const Entry world_operators[] = {
    {"__tostring", method<world_text>, ""},
    {"__eq", equality<WorldHandle>, ""},
};

static const Entry snapshot_operators[] = {
    {"__tostring", method<snapshot_text>, ""},
};

const Library world_library{.name = "clench", .doc = "", .functions = world_functions};

const Class world_class{
    .name = "world",
    .variable = "world",
    .doc = "Bodies and robots, collision filters, friction. Lists are in creation order.",
    .fields = world_fields,
    .methods = world_methods,
    .operators = world_operators,
    .parent = &world_queries_class};

const Class snapshot_class{.name = "snapshot",
                           .variable = "snapshot",
                           .doc = "A saved state of a world, restored by `world:restore`.",
                           .operators = snapshot_operators};

}  // namespace clench
