#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/world/robots.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/object.h"

#include <cmath>
#include <filesystem>

#include "clench/base/convert.h"
#include "clench/io/graspit/virtual_contacts.h"
#include "clench/model/dof.h"
#include "clench/motion/virtual_contacts.h"
#include "clench/script/bind/output.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

using Eigen::VectorXd;
using Contacts = std::vector<VirtualContactSpec>;

// --- eigengrasps ---

static int set_eigengrasps(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  std::shared_ptr<const EigengraspSet> set;
  if (given(L, 2)) {
    const auto* given_set = to<EigengraspsHandle>(L, 2);
    if (!given_set) fail_expected({L, {}, ""}, "eigengrasps", 2);
    set = std::make_shared<EigengraspSet>(given_set->value());
  }
  robot.world->set_eigengrasps(robot.id, std::move(set));
  return 0;
}

// the posture of the amplitudes, each DOF clamped to its limits
struct Expected {
  VectorXd dofs;
  std::vector<int> clamped;
};

static Expected expected_posture(lua_State* L, const RobotHandle& robot, Table& options) {
  const Eigengrasps grasps(*robot);
  VectorXd amplitudes = check_amplitudes(L, 2, grasps);
  const bool keep = options.boolean("keep", false);
  if (options.has("fixed")) {
    // fixed amplitudes keep their present values
    const VectorXd now = grasps.amplitudes(robot.world->dofs(robot.id));
    for (const double x : options.numbers("fixed")) {
      if (!(x >= 1 && x <= grasps.size() && x == std::floor(x)))
        fail("{}: fixed: expected one of {} eigengrasps, got {}", options.subject(), grasps.size(),
             x);
      amplitudes[floor_int(x) - 1] = now[floor_int(x) - 1];
    }
  }
  options.done();
  Expected out{
      keep ? grasps.posture(amplitudes, robot.world->dofs(robot.id)) : grasps.posture(amplitudes),
      {}};
  for (int d = 0; d < out.dofs.size(); ++d) {
    const auto [low, high] = range_around(*robot, d, out.dofs[d]);
    const double inside = std::clamp(out.dofs[d], low, high);
    // rounding errors do not count as limits
    if (std::abs(inside - out.dofs[d]) > 1e-12 * std::max(1.0, std::abs(inside)))
      out.clamped.push_back(d + 1);
    out.dofs[d] = inside;
  }
  return out;
}

static int set_amplitudes_field(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table none(L, 3);
  robot.world->set_dofs(robot.id, expected_posture(L, robot, none).dofs);
  return 0;
}

static int set_amplitudes(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 3);
  const Expected expected = expected_posture(L, robot, options);
  robot.world->set_dofs(robot.id, expected.dofs);
  return push(L, expected.clamped);
}

static int move_amplitudes(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 3);
  const DriveOptions driving{.stop_at_contact = options.boolean("stop_at_contact", false)};
  const Expected expected = expected_posture(L, robot, options);
  push_drive(L, robot.world, drive_to(*robot.world, robot.id, expected.dofs, driving));
  set_field(L, "clamped", expected.clamped);
  return 1;
}

// --- virtual contacts ---

static int get_virtual_contacts(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_virtual_contacts(L, robot, virtual_contacts(*robot.world, robot.id));
}

static void give(const RobotHandle& robot, Contacts contacts) {
  robot.world->set_virtual_contacts(robot.id, std::make_shared<Contacts>(std::move(contacts)));
}

static std::string source_stem(const Robot& robot) {
  return std::filesystem::path(robot.source).stem().string();
}

// warns if contacts were made for a hand of another file
static void warn_of_other_hand(lua_State* L, const RobotHandle& robot,
                               const std::string& made_for) {
  if (made_for.empty() || made_for == robot->name || made_for == source_stem(*robot)) return;
  Diagnostic doubt(
      Place("", 0, subject(L)),
      fmt::format("virtual contacts made for '{}' are used for '{}'", made_for, robot->name));
  doubt.about = About::suspicious;
  log(L, doubt);
}

static int set_virtual_contacts(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  if (!given(L, 2)) {
    robot.world->set_virtual_contacts(robot.id, nullptr);
    return 0;
  }
  Contacts contacts;
  std::string other_hand;
  const auto read = [&](int i, const What& what) {
    contacts.push_back(read_virtual_contact(L, i, what, robot));
    const auto* other = to<VirtualContactHandle>(L, i);
    if (other && other_hand.empty() && other->robot.world->alive(other->robot.id))
      other_hand = source_stem(*other->robot);
  };
  each_item(L, 2, {L, {}, "virtual_contacts"}, "a list of virtual contacts", read, "robot");
  lua_pushstring(L, "robot");
  const bool told = lua_rawget(L, 2) == LUA_TSTRING;  // in the format of lists from files
  const std::string made_for = told ? std::string(string_at(L, -1)) : other_hand;
  lua_pop(L, 1);
  give(robot, std::move(contacts));
  warn_of_other_hand(L, robot, made_for);
  return 0;
}

static int add_virtual_contact(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Contacts contacts = virtual_contacts(*robot.world, robot.id);
  contacts.push_back(read_virtual_contact(L, 2, {L, {}, "contact"}, robot));
  const VirtualContactSpec added = contacts.back();
  give(robot, std::move(contacts));
  return push_object(L, VirtualContactHandle{robot, added});
}

static int remove_virtual_contact(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Contacts contacts = virtual_contacts(*robot.world, robot.id);
  const int number = check_int(L, 2, "number"), count = static_cast<int>(contacts.size());
  if (number < 1 || number > count)
    fail("{}: number: expected one of {} virtual contacts, got {}", subject(L), count, number);
  contacts.erase(contacts.begin() + (number - 1));
  give(robot, std::move(contacts));
  return 0;
}

static int find_sites(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  Table options(L, 2);
  FindSitesOptions finding;
  finding.count_per_link = options.integer("count_per_link", finding.count_per_link);
  finding.palm = options.boolean("palm", finding.palm);
  finding.object_material = options.string("object_material", finding.object_material);
  options.done();
  return push_virtual_contacts(L, robot, find_virtual_contacts(*robot.world, robot.id, finding));
}

static int save_virtual_contacts(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  const auto set =
      contact_set(robot->name, robot->chains, virtual_contacts(*robot.world, robot.id));
  write_virtual_contacts(set, check_output(L, 2));
  return 0;
}

// --- glove and sensor ---

int push(lua_State* L, const GloveCalibration& glove) {
  return push_record(L, {{"slopes", glove.slopes}, {"intercepts", glove.intercepts}});
}

static int push(lua_State* L, const TrackerSpec& tracker) {
  return push_record(L, {{"number", tracker.number}, {"pose", tracker.X_BS}});
}

// --- parts that are stored as their file describes them ---

// a list of the results of push_part(part, link) for all parts of the robot, with the base or link
// of each
template <class Part, class PushPart>
static int push_parts(lua_State* L, std::vector<Part> PassiveParts::*list, PushPart push_part) {
  const auto& robot = self<RobotHandle>(L);
  const std::vector<Part> none;
  const auto link = [&](int number) { return BodyHandle{robot.world, robot->body_of(number)}; };
  return push_list_of(L, robot->passive ? (*robot->passive).*list : none,
                      [&](const Part& part) { push_part(part, link); });
}

static int get_tendons(lua_State* L) {
  return push_parts(L, &PassiveParts::tendons, [L](const TendonSpec& t, auto link) {
    const auto push_points = [&] {
      push_list_of(L, t.points, [&](const TendonPoint& p) {
        push_record(L, {{"link", link(p.link)}, {"point", p.p_L}, {"friction", p.friction}});
      });
    };
    push_record(L, {{"name", t.name},
                    {"stiffness", t.stiffness},
                    {"rest_length", t.rest_length},
                    {"pre_tension_length", t.pre_tension_length},
                    {"points", push_points}});
  });
}

static int push(lua_State* L, const TendonWrapper::Side& side) {
  return push_record(L, {{"tendon", side.tendon}, {"direction", side.direction_L}});
}

static int get_tendon_wrappers(lua_State* L) {
  return push_parts(L, &PassiveParts::wrappers, [L](const TendonWrapper& w, auto link) {
    push_record(L, {{"link", link(w.link)},
                    {"point", w.p_L},
                    {"axis", w.axis_L},
                    {"radius", w.radius},
                    {"friction", w.friction},
                    {"exempt", w.exempt},
                    {"sides", w.sides}});
  });
}

static int get_tactile_sensors(lua_State* L) {
  return push_parts(L, &PassiveParts::tactile, [L](const TactileSpec& s, auto link) {
    push_record(L, {{"link", link(s.link)}, {"low", s.low_L}, {"high", s.high_L}});
  });
}

static int get_joint_tendons(lua_State* L) {
  const auto& robot = self<RobotHandle>(L);
  return push_list_of(L, robot->joint_tendons, [&](const JointTendonSpec& t) {
    std::vector<int> dofs;
    std::vector<double> arms;
    double length = 0;
    for (const auto& [dof, arm] : t.arms) {
      dofs.push_back(dof + 1);
      arms.push_back(arm);
      length += arm * robot.world->dofs(robot.id)[dof];
    }
    push_record(L, {{"name", t.name},
                    {"dofs", dofs},
                    {"arms", arms},
                    {"length", length},
                    {"range", t.range},
                    {"stiffness", t.stiffness},
                    {"slack", t.slack},
                    {"damping", t.damping},
                    {"friction", t.friction}});
  });
}

static int push(lua_State* L, const TendonPull& pull) {
  return push_record(L, {{"joint", pull.joint}, {"coefficient", pull.coefficient}});
}

static int get_actuators(lua_State* L) {
  return push_parts(L, &PassiveParts::actuators, [L](const ActuatorSpec& a, auto) {
    push_record(L, {{"kind", a.kind},
                    {"gear", a.gear},
                    {"control_range", a.control_range},
                    {"force_range", a.force_range}});
    if (!a.name.empty()) set_field(L, "name", a.name);
    if (!a.joint.empty()) set_field(L, "joint", a.joint);
    if (!a.tendon.empty()) set_field(L, "tendon", a.tendon);
    if (a.dof >= 0) set_field(L, "dof", a.dof + 1);
    if (!a.pulls.empty()) set_field(L, "pulls", a.pulls);
    if (a.tendon_force_range) set_field(L, "tendon_force_range", *a.tendon_force_range);
    if (a.law_range) set_field(L, "law_range", *a.law_range);
    if (!a.enabled) set_field(L, "enabled", false);
    if (!a.law_known) return;
    if (a.activation_range) set_field(L, "activation_range", *a.activation_range);
    if (a.gain_slopes != std::array{0.0, 0.0}) set_field(L, "gain_slopes", a.gain_slopes);
    set_field(L, "gain", a.gain);
    set_field(L, "bias", a.bias);
    if (a.damping_ratio > 0) set_field(L, "damping_ratio", a.damping_ratio);
  });
}

// --- tables ---

static const Entry hand_fields[] = {
    {"eigengrasps", getter<[](const RobotHandle& x) {
       return EigengraspsHandle{x, nullptr};
     }>,
     R"(
Its present eigengrasps: those of its file, or one per DOF. Setting it copies a set; nil restores one per DOF.
@type eigengrasps
> hand.eigengrasps = clench.eigengrasps{vectors = {{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}}}
> hand.eigengrasps  --> 1 eigengrasp of 12 DOFs
> hand.eigengrasps = clench.eigengrasps{vectors = {{1, 1}}}  --> error: expected a set for 12 DOFs, got one for 2)",
     guarded<set_eigengrasps>},
    {"amplitudes",
     getter<[](const RobotHandle& x) { return Eigengrasps(*x).amplitudes(x.world->dofs(x.id)); }>,
     R"(
Amplitudes for which the posture of its eigengrasps is nearest to its own. Setting them sets that posture, as set_amplitudes does.
@type number[]
> hand.eigengrasps = clench.eigengrasps{vectors = {{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}}}
> hand.amplitudes = {0.25}
> math.abs(hand.amplitudes[1] - 0.25) < 1e-12  --> true)",
     guarded<set_amplitudes_field>},
    {"virtual_contacts", guarded<get_virtual_contacts>, R"(
Its desired contact points: those of its file or of a script or, if there are neither, those that
find_virtual_contacts computes, at each access. Set to a list of virtual contacts, contacts, or tables as taken by
add_virtual_contact; to {} for none; to nil for computed ones.
@type virtual_contact[]
> hand.virtual_contacts = {{link = "chain0_link2", point = {0, 0, 0}, normal = {0, 0, 1}, mu = 0.5}}
> hand.virtual_contacts[1].mu  --> 0.5
> hand.virtual_contacts = {}
> #hand.virtual_contacts  --> 0)",
     guarded<set_virtual_contacts>},
    {"has_own_virtual_contacts",
     getter<[](const RobotHandle& robot) { return robot->virtual_contacts != nullptr; }>, R"(
Do its virtual contacts come from a file or a script? Otherwise they are computed from its geometry.
@type boolean
> hand.has_own_virtual_contacts  --> true
> hand.virtual_contacts = nil
> hand.has_own_virtual_contacts  --> false)"},
    {"glove", getter<[](const RobotHandle& x) {
       return x->glove ? std::optional(*x->glove) : std::nullopt;
     }>,
     R"(
Calibration of the data glove that is named in its file: `slopes` (a row per DOF, a number per sensor) and `intercepts`, so that
DOF = intercept + slopes * raw. nil if there is none.
@type {slopes: number[][], intercepts: number[]}?  [rad per count, rad]
> hand.glove  --> nil)"},
    {"tracker", getter<[](const RobotHandle& x) { return x->tracker; }>, R"(
Position sensor on it: its `number` and its mounting `pose` in the base. nil if there is none.
@type {number: index, pose: pose}?
> hand.tracker  --> nil)"},
    {"tendons", guarded<get_tendons>, R"(
Tendons of its file, unchanged; they exert no force. Points are in the frame of their link.
@type {name: string, stiffness: number, rest_length?: number, pre_tension_length?: number, points: {link: body, point: vec3, friction: number}[]}[]  [N/m, m]
> #hand.tendons  --> 0)"},
    {"tendon_wrappers", guarded<get_tendon_wrappers>, R"(
Posts around which tendons wrap, each an infinite cylinder; `exempt` names the tendons that ignore it, `sides` states on which
side of it the others pass. They have no effect.
@type {link: body, point: vec3, axis: vec3, radius: number, friction: number, exempt: string[], sides: {tendon: string, direction: vec3}[]}[]
> #hand.tendon_wrappers  --> 0)"},
    {"joint_tendons", guarded<get_joint_tendons>, R"(
Fixed tendons of an MJCF file that have a range, a spring or friction: `length` is the sum of `arms` times `dofs`. In
simulations the length stays in `range`, a spring acts if it is outside `slack`, and each DOF receives its moment arm times the
force of the tendon. They are ignored by methods that set DOFs without a simulation, and by the engine "ode".
@type {name: string, dofs: index[], arms: number[], length: number, range?: number[], stiffness: number, slack: number[], damping: number, friction: number}[]
> #hand.joint_tendons  --> 0)"},
    {"actuators", guarded<get_actuators>, R"(
Actuators as an MJCF file describes them: `name`, `kind` ("motor", "position", "general"), `joint` or
`tendon` with the joints that it `pulls`, `dof` that it moves, `gear`, `control_range`, `force_range`, and its law: force = gain * control + bias[1] +
bias[2] * length + bias[3] * velocity. If the file defines them: `gain_slopes`, which multiplied by length and velocity are added to the gain; `activation_range`, of the
activation that replaces the control in the law; `law_range` of the force of a muscle, which only pulls; `tendon_force_range` of all actuators of the tendon; `enabled`, false
for one that exerts nothing. `damping_ratio` is the `dampratio` of a servo, whose damping is not in its law. The motors take
from them the driven DOFs, the maximum efforts, and, as kp and kd, the values of bias[2] and bias[3] for DOFs
and for tendons; a script that sets forces can apply their laws.
@type table[]
> #hand.actuators  --> 0)"},
    {"tactile_sensors", guarded<get_tactile_sensors>, R"(
Boxes, each of which senses its contacts as one sensor, by their `low` and `high` corners in the frame of their `link`. They have
no effect.
@type {link: body, low: vec3, high: vec3}[]
> #hand.tactile_sensors  --> 0)"},
};

static const Entry hand_methods[] = {
    {"set_amplitudes", guarded<set_amplitudes>, R"(
Sets the posture given by amplitudes of its eigengrasps, without collision checks. DOFs stop at their limits.
@param amplitudes number[]  one amplitude per eigengrasp
@param options? table  what is kept
@option keep? boolean = false  true: the part of the posture that is no combination of eigengrasps is kept
@option fixed? index[]  numbers of the amplitudes that stay as they are
@return index[] clamped  numbers of the DOFs whose limit was in the way
@effect edits
> hand.eigengrasps = clench.eigengrasps{vectors = {{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}}}
> hand:set_amplitudes{0.1}  --> {}
> hand:set_amplitudes{100}  --> {1, 4, 7, 10}
> hand:set_amplitudes({0.1}, {fixed = {1}})  --> {}
> hand:set_amplitudes({0.1}, {fixed = {2}})  --> error: fixed: expected one of 1 eigengrasps, got 2
> hand:set_amplitudes{1, 2}  --> error: expected 1 amplitudes, got 2)"},
    {"move_amplitudes", guarded<move_amplitudes>, R"(
Drives the DOFs towards the posture of the given amplitudes, as move_dofs does, until contact stops them.
@param amplitudes number[]  one amplitude per eigengrasp
@param options? table  how it moves
@like hand:set_amplitudes
@option stop_at_contact? boolean = false  true: end at the first new contact of any link
@return table result  as of autograsp, and `clamped`, numbers of the DOFs whose limit was in the way
@effect edits
> hand:move_amplitudes(hand.amplitudes, {keep = true}).moved  --> false)"},
    {"add_virtual_contact", guarded<add_virtual_contact>, R"(
Adds a virtual contact: at a present contact, or in the frame of a link (a body or its name).
@param contact contact|virtual_contact|table  a contact to mark, or a table of these options
@option link body|string|index  the link or its name; or its number on the chain
@option chain? integer [>= 0]  number of the chain of a link that is given by its number; 0: the base
@option point? vec3 [m]  in the link
@option normal? vec3  out of the link
@option frame? pose  instead of point and normal: z out of the link
@option mu? number [0 to 1e6] = 1  coefficient of friction
@option torsion_radius? number [m, >= 0] = 0  of a soft contact
@option edges? number[][]  of the friction pyramid, instead of torsion_radius
@return virtual_contact
@effect edits
> hand.virtual_contacts = {}
> for _, c in ipairs(world:contacts(hand, flask)) do hand:add_virtual_contact(c) end
> #hand.virtual_contacts == #world:contacts(hand, flask)  --> true
> hand:add_virtual_contact{link = "thumb"}  --> error: has no link 'thumb')"},
    {"remove_virtual_contact", guarded<remove_virtual_contact>, R"(
Removes a virtual contact from its list.
@param number index  number of the contact
@effect edits
> count = #hand.virtual_contacts
> hand:remove_virtual_contact(1)
> #hand.virtual_contacts == count - 1  --> true
> hand:remove_virtual_contact(1000)  --> error: number: expected one of)"},
    {"find_virtual_contacts", guarded<find_sites>, R"(
Contact points on the parts of its surface that move forward when the hand closes: the center of the volume that each link sweeps, by area and
speed along its normal, and one on the palm. Sets nothing.
@param options? table  where they are, and of what is grasped
@option count_per_link? integer [1 to 100] = 1  number of contacts per link, along its length
@option palm? boolean = true  true: one on the palm, too
@option object_material? string = "wood"  material to be grasped
@return virtual_contact[]
@effect reads
> #hand:find_virtual_contacts()  --> 13
> #hand:find_virtual_contacts{count_per_link = 2, palm = false}  --> 24)"},
    {"save_virtual_contacts", guarded<save_virtual_contacts>, R"(
Writes its virtual contacts to a file, .vgr or .xml; clench.files.virtual_contacts reads it.
@param path string  file to write
@effect files
> hand:save_virtual_contacts "sites.doc"  --> error: expected a file of virtual contacts, .vgr or .xml, got '.doc')"},
};

const Class hand_class{.name = "hand",
                       .variable = "hand",
                       .doc =
                           "Parts of a robot used for grasping: eigengrasps, virtual contacts, a "
                           "glove, a position sensor.",
                       .fields = hand_fields,
                       .methods = hand_methods,
                       .parent = &robot_dynamics_class};

}  // namespace clench
