#include <algorithm>

#include "clench/io/grasp_lines.h"
#include "clench/script/bind/grasp/apply_grasp.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/grasp/save_grasp.h"
#include "clench/script/bind/grasp/wrench_spaces.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/world/contacts.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/json.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/values.h"

namespace clench {

PerContact read_per_contact(Table& options, const char* key) {
  if (!options.has(key)) return {};
  if (options.type(key) != LUA_TTABLE) return options.number(key);
  const auto each = options.numbers(key);
  if (each.empty())
    fail("{}: {}: expected a number for each contact, got none", options.subject(), key);
  return each;
}

static int measure(lua_State* L) {
  if (to<BodyHandle>(L, 1) && to<RobotHandle>(L, 2))
    fail("{}: expected the hand first, then the object, got them the other way round", subject(L));
  const auto& hand = check_object<RobotHandle>(L, 1, "hand");
  const auto& object = check_object<BodyHandle>(L, 2, "object");
  if (hand.world != object.world)
    fail("{}: '{}' and '{}' belong to different worlds", subject(L), hand->name, object->name);
  Table options(L, 3);
  GraspOptions grasp;
  grasp.edges = read_edges(options).value_or(grasp.edges);
  if (is_gyration(options))
    grasp.length = TorqueLength::gyration_radius;
  else if (options.has("rho"))
    grasp.rho = options.number("rho");
  grasp.soft = options.boolean("soft", grasp.soft);
  if (const PerContact forces = read_per_contact(options, "normal_force"))
    grasp.normal_force = forces;
  grasp.modulus = read_modulus_rule(options);
  options.done();
  Grasp measured = find_grasp(*hand.world, hand.id, object.id, grasp);
  note_identity(L, *hand.world, measured);
  // once, because planners measure thousands
  static const char at_edges = 0;
  const std::string about = fmt::format("grasp of {} by {}", object->name, hand->name);
  if (measured.contacts_at_edges > 0 && first_time(L, &at_edges, about))
    log_warning(L, fmt::format("{}: {} of {} contacts are soft ones on corners or edges, whose "
                               "patch is an estimate; for later grasps see contact.patch.at_edge",
                               about, measured.contacts_at_edges, measured.contacts.size()));
  return push_object(L, GraspHandle{hand.world, std::move(measured)});
}

const World& world_of(lua_State* L, const GraspHandle& grasp) {
  if (!grasp.world)
    fail(
        "{}: the grasp belongs to no world, like those of planners and files; grasp:apply(world) "
        "gives one that does",
        subject(L));
  return *grasp.world;
}

static int get_grasp_hand(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  world_of(L, g);
  return push(L, RobotHandle{g.world, g.grasp.hand});
}

static int get_object(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  world_of(L, g);
  return push(L, BodyHandle{g.world, g.grasp.object});
}

static int set_info(lua_State* L) {
  auto& g = self<GraspHandle>(L);
  std::map<std::string, double> info;
  if (!lua_istable(L, 2)) fail_expected({L, {}, "value"}, "a table of names and numbers", 2);
  each_named(L, 2, {L, {}, {}}, "names", [&](const std::string& name, int i, const What& what) {
    info[name] = read_number(L, i, what);
  });
  g.grasp.info = std::move(info);
  return 0;
}

static int set_labels(lua_State* L) {
  auto& g = self<GraspHandle>(L);
  std::map<std::string, std::string> labels;
  if (!lua_istable(L, 2)) fail_expected({L, {}, "value"}, "a table of names and strings", 2);
  each_named(L, 2, {L, {}, {}}, "names", [&](const std::string& name, int i, const What& what) {
    if (lua_type(L, i) != LUA_TSTRING) fail_expected(what, "a string", i);
    labels[name] = string_at(L, i);
  });
  g.grasp.labels = std::move(labels);
  return 0;
}

static int push(lua_State* L, const PregraspState& pregrasp) {
  return push_record(L, {{"pose", pregrasp.X_OH}, {"dofs", pregrasp.dofs}});
}

static int set_pregrasp(lua_State* L) {
  auto& g = self<GraspHandle>(L).grasp;
  if (!given(L, 2)) return g.pregrasp.reset(), 0;
  Table table(L, 2);
  g.pregrasp =
      PregraspState{table.pose("pose"), table.numbers("dofs", static_cast<int>(g.dofs.size()))};
  table.done();
  return 0;
}

static int set_squeeze(lua_State* L) {
  auto& g = self<GraspHandle>(L).grasp;
  if (!given(L, 2)) return g.squeeze.clear(), 0;
  const auto values = read_numbers(L, 2, What{L, {}, "value"});
  if (values.size() != g.dofs.size())
    fail("{}: expected {} numbers, one per DOF, got {}", subject(L), g.dofs.size(), values.size());
  g.squeeze = values;
  return 0;
}

static int get_squeeze(lua_State* L) {
  const auto& squeeze = self<GraspHandle>(L).grasp.squeeze;
  return squeeze.empty() ? push_nil(L) : push(L, squeeze);
}

static int push_file(lua_State* L, const std::string& file) {
  return file.empty() ? push_nil(L) : push(L, file);
}

static int get_hand_file(lua_State* L) {
  return push_file(L, self<GraspHandle>(L).grasp.hand_file);
}

static int get_object_file(lua_State* L) {
  return push_file(L, self<GraspHandle>(L).grasp.object_file);
}

static std::vector<double> joint_values(const GraspHandle& x) {
  std::vector<double> out;
  for (size_t j = 0; j < x.grasp.joints.size(); ++j) out.push_back(x.grasp.joint_value(j));
  return out;
}

static int set_collision_free(lua_State* L) {
  auto& g = self<GraspHandle>(L).grasp;
  g.collision_free.reset();
  if (given(L, 2)) g.collision_free = check_boolean(L, 2, "value");
  return 0;
}

static int get_epsilon(lua_State* L) {
  const auto& [world, g] = self<GraspHandle>(L);
  if (const auto known = g.measures.find("epsilon"); known != g.measures.end())
    return push(L, known->second);
  // a line of a file without points has no information on contacts
  if (!world && g.points.empty()) return push_nil(L);
  return push(L, space_of(g)->epsilon());
}

// value in a file
static int grasp_as_json(lua_State* L) {
  read_json(L, grasp_line(self<GraspHandle>(L).grasp));
  return 1;
}

static int get_grasp_contacts(lua_State* L) {
  const auto& g = self<GraspHandle>(L);
  world_of(L, g);
  return push_contacts(L, g.world, g.grasp.contacts);
}

static int push(lua_State* L, const PointContact& point) {
  return push_record(L, {{"point", point.p_O},
                         {"normal", point.n_O},
                         {"mu", point.mu},
                         {"torsion_radius", point.torsion_radius}});
}

static int push_edges(lua_State* L, int edges) {
  return edges == round_edges ? push(L, "exact") : push(L, edges);
}

static int get_grasp_edges(lua_State* L) {
  return push_edges(L, self<GraspHandle>(L).grasp.options.edges);
}

static int get_options(lua_State* L) {
  const Grasp& g = self<GraspHandle>(L).grasp;
  const auto& forces = g.options.normal_force.values;
  return push_record(
      L, {{"edges", [&] { push_edges(L, g.options.edges); }},
          {"rho", g.rho},
          {"soft", g.options.soft},
          {"normal_force", [&] { forces.size() == 1 ? push(L, forces[0]) : push(L, forces); }},
          {"modulus", modulus_name(g.options.modulus)}});
}

static int grasp_space(lua_State* L) {
  auto& g = self<GraspHandle>(L);
  Table table(L, 2);
  GraspSpaceOptions options;
  options.edges = read_edges(table);
  if (is_gyration(table))
    options.rho = g.grasp.gyration_radius;
  else if (table.has("rho"))
    options.rho = table.number("rho");
  options.space = read_space_options(table);
  table.done();
  return push(L, space_of(g.grasp, options));
}

static const Entry grasp_functions[] = {
    {"grasp", guarded<measure>, R"(
The present grasp of a hand on an object. A grasp without contacts is not an error: it resists nothing.
@param hand robot  hand that holds the object
@param object body  object that is held
@param options? table  how its contacts are rated
@option edges? integer|"exact" [3 to 1000] = 8  of the friction pyramids; exact: round cones
@option rho? number|"gyration" [m, > 0]  torque length, by default the object's largest radius about its center of mass; gyration: its radius of gyration
@option soft? boolean = true  false: soft contacts are points, without torsional friction
@option normal_force? number|number[] [N, > 0] = 5  at which soft contacts are rated, or a list of one per contact
@like patch:ellipse  modulus
@return grasp
@effect reads
> clench.grasp(hand, flask):is_force_closure()  --> true
> clench.grasp(flask, hand)  --> error: expected the hand first, then the object)"},
};

static const Entry grasp_fields[] = {
    {"hand", guarded<get_grasp_hand>, R"(
The robot that grasps.
@type robot
> grasp.hand == hand  --> true)"},
    {"object", guarded<get_object>, R"(
The body that is grasped.
@type body
> grasp.object == flask  --> true)"},
    {"hand_name", getter<[](const GraspHandle& x) { return x.grasp.hand_name; }>,
     R"(
Name of the robot that grasps; grasps outside any world have it, too.
@type string
> grasp.hand_name == hand.name  --> true)"},
    {"object_name", getter<[](const GraspHandle& x) { return x.grasp.object_name; }>, R"(
Name of the body that is grasped.
@type string
> grasp.object_name  --> flask)"},
    {"hand_file", guarded<get_hand_file>, R"(
Path from which the hand was read, as it was given; nil if unknown.
@type string?
> grasp.hand_file == hand.source  --> true)"},
    {"object_file", guarded<get_object_file>, R"(
Path from which the object was read, as it was given; nil if unknown.
@type string?
> grasp.object_file == flask.source  --> true)"},
    {"hand_fingerprint", getter<[](const GraspHandle& x) { return x.grasp.hand_fingerprint; }>, R"(
Fingerprint of the hand's shapes and joints when the grasp was measured (its `mechanism_fingerprint`); "" if the grasp is from a file without it.
@type string
> grasp.hand_fingerprint == hand.mechanism_fingerprint  --> true)"},
    {"object_fingerprint", getter<[](const GraspHandle& x) { return x.grasp.object_fingerprint; }>,
     R"(
Fingerprint of the object's surface when the grasp was measured (that of its mesh); "" if the grasp is from a file without it.
@type string
> grasp.object_fingerprint == flask.mesh.fingerprint  --> true)"},
    {"settings_fingerprint",
     getter<[](const GraspHandle& x) { return x.grasp.settings_fingerprint; }>, R"(
Fingerprint of the options of the measures: edges, rho, soft, normal_force and modulus. Measures of grasps with equal fingerprints can be compared.
@type string
> again = clench.grasp(hand, flask, {edges = 12})
> again.settings_fingerprint == grasp.settings_fingerprint  --> false)"},
    {"engine_version", getter<[](const GraspHandle& x) { return x.grasp.engine_version; }>, R"(
Version of Clench that measured the grasp; "" if the grasp is from a file without it.
@type string
> grasp.engine_version == clench.version  --> true)"},
    {"pose", getter<[](const GraspHandle& x) { return x.grasp.X_OH; }>, R"(
Pose of the hand's base in the object's frame when the grasp was measured.
@type pose
> (flask.pose * grasp.pose).position == hand.pose.position  --> true)"},
    {"dofs", getter<[](const GraspHandle& x) { return x.grasp.dofs; }>, R"(
Values of the hand's DOFs when the grasp was measured.
@type number[]  [rad or m]
> #grasp.dofs == #hand.dofs  --> true)"},
    {"dof_names", getter<[](const GraspHandle& x) { return x.grasp.dof_names; }>, R"(
Names of these DOFs; empty if the grasp is from a file that does not name them.
@type string[]
> grasp.dof_names[2] == hand.dof_names[2]  --> true)"},
    {"joint_positions", getter<[](const GraspHandle& x) { return x.grasp.joints; }>, R"(
Positions of the hand's joints when the grasp was measured.
@type number[]  [rad or m]
> #grasp.joint_positions > #grasp.dofs  --> true)"},
    {"joint_names", getter<[](const GraspHandle& x) { return x.grasp.joint_names; }>, R"(
Names of these joints, including followers: that in the hand's file; otherwise the DOF's name, for the joint with the value of the DOF; otherwise "chain0_joint1". Empty if the grasp
is from a file that does not name them.
@type string[]
> #grasp.joint_names == #grasp.joint_positions  --> true)"},
    {"joint_values", method<joint_values>, R"(
The same positions in the convention of the hand's file, which other programs expect; the two differ if the file's joint has
another zero.
@type number[]  [rad or m]
> #grasp.joint_values == #grasp.joint_names  --> true)"},
    {"measures", getter<[](const GraspHandle& x) { return x.grasp.measures; }>, R"(
Measures that have been computed so far, by name; files store them with the grasp.
@type table<string, number>
> epsilon = grasp:quality "epsilon"
> grasp.measures.epsilon == epsilon  --> true)"},
    {"info", getter<[](const GraspHandle& x) { return x.grasp.info; }>, R"(
Numbers of a script, by name, such as a seed, an energy or the number of a run. Files store them.
@type table<string, number>
> grasp.info = {seed = 7}
> grasp.info.seed  --> 7.0
> grasp.info = {seed = "x"}  --> error: seed: expected a number, got 'x')",
     guarded<set_info>},
    {"labels", getter<[](const GraspHandle& x) { return x.grasp.labels; }>, R"(
Texts of a script, by name, such as its planner or its file. Files store them.
@type table<string, string>
> grasp.labels = {planner = "mine"}
> grasp.labels.planner  --> mine
> grasp.labels = {planner = 3}  --> error: planner: expected a string, got 3)",
     guarded<set_labels>},
    {"pregrasp", getter<[](const GraspHandle& x) { return x.grasp.pregrasp; }>, R"(
The hand before it approaches the object and closes: the `pose` of its base in the object frame, and its `dofs`; nil if
unknown. Planners set it; files store it.
@type {pose: pose, dofs: number[]}?
> grasp.pregrasp  --> nil
> grasp.pregrasp = {pose = grasp.pose, dofs = grasp.dofs}
> #grasp.pregrasp.dofs == #hand.dofs  --> true)",
     guarded<set_pregrasp>},
    {"squeeze", guarded<get_squeeze>, R"(
Motor targets that press on the object, one per DOF, possibly beyond its limits; nil if unknown. Planners that verify set it; files store it.
@type number[]?  [rad or m]
> grasp.squeeze  --> nil
> grasp.squeeze = grasp.dofs
> #grasp.squeeze == #hand.dofs  --> true
> grasp.squeeze = {1}  --> error: numbers, one per DOF, got 1)",
     guarded<set_squeeze>},
    {"collision_free", getter<[](const GraspHandle& x) { return x.grasp.collision_free; }>, R"(
Was the grasp free of collisions? nil: not checked. Planners set it; files store it.
@type boolean?
> grasp.collision_free = not world:collides()
> grasp.collision_free  --> true)",
     guarded<set_collision_free>},
    {"epsilon", guarded<get_epsilon>, R"(
The measure "epsilon", as it was measured or, otherwise, computed from the points; nil for a grasp from a file that has neither.
@type number?
> grasp.epsilon == grasp:quality "epsilon"  --> true)"},
    {"contacts", guarded<get_grasp_contacts>, R"(
The contacts on the object when the grasp was measured.
@type contact[]
> grasp.contacts[1].body == flask  --> true)"},
    {"points", getter<[](const GraspHandle& x) { return x.grasp.points; }>, R"(
The same contacts in the object's frame, as clench.wrench_space takes them; torsion_radius is 0 for hard fingers.
@type {point: vec3, normal: vec3, mu: number, torsion_radius: number}[]  [m]
> again = clench.wrench_space{contacts = grasp.points, com = flask.com, rho = grasp.rho}
> again:epsilon() == grasp:quality "epsilon"  --> true)"},
    {"links", getter<[](const GraspHandle& x) { return x.grasp.links; }>, R"(
Name of the touching body at each of the points.
@type string[]
> #grasp.links == #grasp.points, grasp.links[1] == grasp.contacts[1].other.name  --> true, true)"},
    {"rho", getter<[](const GraspHandle& x) { return x.grasp.rho; }>, R"(
Length by which torques are divided.
@type number  [m]
> grasp.rho > 0  --> true)"},
    {"com", getter<[](const GraspHandle& x) { return x.grasp.com; }>, R"(
The object's center of mass when the grasp was measured, in the object frame; torques are about it.
@type vec3  [m]
> grasp.com == flask.com  --> true)"},
    {"edges", guarded<get_grasp_edges>, R"(
Edges of each friction pyramid, or "exact".
@type integer|string
> grasp.edges  --> 8)"},
    {"options", guarded<get_options>, R"(
The options with which clench.grasp measures another grasp in the same way.
@type {edges: integer|string, rho: number, soft: boolean, normal_force: number|number[], modulus: string}  rho [m], normal_force [N]
> clench.grasp(hand, flask, grasp.options):quality "epsilon" == grasp:quality "epsilon"  --> true)"},
};

static const Entry grasp_methods[] = {
    {"apply", guarded<apply_by_script>, R"(
Puts the hand back into its pose relative to the object at the object's present pose, sets its joints, and measures the grasp
there. Hand and object are found by name unless they are given. DOFs are found by name if the grasp has names; DOFs that it
does not contain keep their values. Joints that a DOF moves may be listed, too: a warning names one that differs from the value given by its DOF. A
value up to 0.02 rad or 1 mm beyond a limit is set to the limit, with a warning if it is more than the rounding of 32 bits. DOFs without names are taken in
the hand's order, with a warning if Isaac Sim numbers them differently, unless `dof_order` gives the order: "hand"; "isaac", which is breadth first; or a list of names. If an arm carries the hand, the arm moves with everything that it carries, to the first posture that `ik` finds from its present one. Nothing else moves, and collisions are not checked: see `world:collides`.
A warning names a hand with other shapes or joints, or an object with another surface, than those of the measured grasp; masses, materials, limits and motors may differ.
@param world? world  default: its own
@param options? table  the hand and the object, if not those of the grasp's names
@option hand? robot  in that world
@option object? body  in that world
@option dof_order? string|string[]  names of DOFs that the grasp does not name: a list, "isaac" (breadth first) or "hand"
@return grasp
@effect edits
> #grasp:apply(world, {hand = hand, object = flask}).contacts == #grasp.contacts  --> true
> hand:open()
> again = grasp:apply()
> #again.contacts == #grasp.contacts, math.abs(again:quality "epsilon" - grasp:quality "epsilon") < 1e-9  --> true, true
> grasp:apply(clench.world{})  --> error: there is no such hand in this world)"},
    {"dofs_for", guarded<grasp_dofs_for>, R"(
Values of all DOFs of a hand as `apply` would set them, and of its pregrasp, if it has one.
@param hand robot  hand whose DOFs are wanted
@param options? table  the order of its DOFs
@like grasp:apply  dof_order
@return number[] dofs, number[]? pregrasp  [rad or m]
@effect reads
> #grasp:dofs_for(hand) == #hand.dofs  --> true)"},
    {"save", guarded<save_grasp>, R"(
Writes the grasp in its world as a scene of MuJoCo, as world:save does. The base of the hand is on slides, named carriage_x, carriage_y
and carriage_z, along the axes of the world. The keyframes "pregrasp", "grasp" and "lift" contain postures and motor controls: in "grasp" and
"lift" the motors press towards the targets of `squeeze`, or, without it or with `force`, with contact forces in equilibrium; between "grasp" and "lift" the hand rises.
@param path string  .xml or .mjcf
@param options? table  the keys of the scene
@option force? number [N, > 0]  sum of the normal forces, 10 times the object's weight by default, less if the motors cannot exert that
@option height? number [m, > 0] = 0.1  height of the lift
@option confine? string  folder outside of which no file is read or written, by default that of --confine
@effect files
> path = os.tmpname()
> grasp:save(path .. ".xml")
> clench.load(path .. ".xml", {keyframe = "lift"}).keyframes[2]  --> grasp
> os.remove(path)
> os.remove(path .. ".xml")
> grasp:save "grasp.wld"  --> error: expected a scene of MuJoCo to .xml or .mjcf, got '.wld')"},
    {"is_force_closure",
     method<[](const GraspHandle& x) { return space_of(x.grasp)->is_force_closure(); }>, R"(
Can the grasp resist every wrench?
@return boolean
@effect reads
> grasp:is_force_closure()  --> true)"},
    {"wrench_space", guarded<grasp_space>, R"(
Its wrench space about the object's center of mass: in the norm "L1" or "Linf"; with edges and rho of the grasp, or others;
in some of the coordinates "fx" to "tz". All contacts together have at most 100,000 edges; more is an error of the kind "limit". The same options give the same space, which caches its results.
@param options? table  how its contacts are combined
@like clench.wrench_space  norm, edges, coordinates
@option rho? number|"gyration" [m, > 0]  torque length, by default that of the grasp; gyration: the object's radius of gyration
@return wrench_space
@effect reads
> grasp:wrench_space().rank  --> 6
> grasp:wrench_space{norm = "Linf"}:epsilon() >= grasp:wrench_space():epsilon()  --> true
> grasp:wrench_space{edges = "exact"}:epsilon() >= grasp:wrench_space():epsilon()  --> true
> grasp:wrench_space{coordinates = {"fx", "fy", "fz"}}.rank  --> 3
> grasp:wrench_space{norm = "L2"}  --> error: L2)"},
};

static const Entry grasp_operators[] = {
    {"__tostring", method<[](const GraspHandle& x) {
       return fmt::format("grasp of {} contacts, epsilon {:.6g}", x.grasp.points.size(),
                          space_of(x.grasp)->epsilon());
     }>,
     ""},
    {"__json", guarded<grasp_as_json>, ""},
};

const Library grasp_library{.name = "clench", .doc = "", .functions = grasp_functions};

const Class grasp_class{.name = "grasp",
                        .variable = "grasp",
                        .doc =
                            "A hand, an object and the contacts between them, as they were when "
                            "the grasp was measured.",
                        .fields = grasp_fields,
                        .methods = grasp_methods,
                        .operators = grasp_operators,
                        .parent = &measures_class};

}  // namespace clench
