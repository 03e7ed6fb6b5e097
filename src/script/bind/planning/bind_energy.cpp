#include <numbers>

#include "clench/planning/energy/closing_energy.h"
#include "clench/planning/energy/constraint_energy.h"
#include "clench/script/bind/grasp/wrench_spaces.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/planning/planning.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

namespace {

struct Subject {
  WorldPtr world;
  HandAndObject who;
};

Subject read_hand(Table& options) {
  const auto* hand = options.object<RobotHandle>("hand");
  if (!hand) fail("{}: hand: expected a robot, got nothing", options.subject());
  hand->world->robot(hand->id);  // alive
  return {hand->world, {.hand = hand->id, .object = {}}};
}

Subject read_subject(Table& options) {
  Subject out = read_hand(options);
  const auto* object = options.object<BodyHandle>("object");
  if (!object) fail("{}: object: expected a body, got nothing", options.subject());
  if (object->world != out.world)
    fail("{}: object: '{}' belongs to another world than the hand", options.subject(),
         (*object)->name);
  out.who.object = object->id;
  return out;
}

SiteKind read_contacts(Table& options) {
  return options.choice("contacts", {{"preset", SiteKind::preset}, {"live", SiteKind::live}},
                        SiteKind::preset);
}

int push_energy(lua_State* L, const WorldPtr& world, EnergyPtr energy) {
  return push_object(L, EnergyHandle{world, std::move(energy)});
}

Facing read_facing(Table& options, Facing usual) {
  return options.choice(
      "facing",
      {{"nearest", Facing::nearest}, {"surface", Facing::surface}, {"away", Facing::away}}, usual);
}

ContactEnergy::Options read_contact_options(Table& options) {
  ContactEnergy::Options out{.contacts = read_contacts(options)};
  out.normal_weight = options.number("normal_weight", out.normal_weight);
  out.facing = read_facing(options, Facing::nearest);
  return out;
}

PotentialQuality::Options read_potential_options(Table& options, SiteKind contacts) {
  PotentialQuality::Options out{.contacts = contacts};
  out.reach = options.number("reach", out.reach);
  out.min_count = options.integer("min_count", out.min_count);
  out.torques = options.boolean("torques", out.torques);
  return out;
}

std::vector<Vector6d> read_tasks(Table& options) {
  std::vector<Vector6d> out;
  if (options.has("tasks"))
    for (const auto& row : options.rows("tasks", 6)) out.push_back(vector_of(row));
  return out;
}

ClosingEnergy::Options read_closing_options(Table& options, ClosingEnergy::Options out) {
  out.volume_weight = options.number("volume_weight", out.volume_weight);
  out.epsilon_weight = options.number("epsilon_weight", out.epsilon_weight);
  out.tasks = read_tasks(options);
  out.task_weight = options.number("task_weight", out.tasks.empty() ? 0 : 1);
  if (const auto edges = read_edges(options)) out.grasp.edges = *edges;
  return out;
}

// --- the named energies ---

int contact(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_subject(options);
  const auto reading = read_contact_options(options);
  options.done();
  return push_energy(L, world, std::make_unique<ContactEnergy>(*world, who, reading));
}

int potential_quality(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_subject(options);
  const auto reading = read_potential_options(options, read_contacts(options));
  options.done();
  return push_energy(L, world, std::make_unique<PotentialQuality>(*world, who, reading));
}

int guided_potential_quality(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_subject(options);
  const auto reading = read_contact_options(options);
  const auto potential = read_potential_options(options, reading.contacts);
  options.done();
  return push_energy(
      L, world,
      std::make_unique<GuidedEnergy>(std::make_unique<PotentialQuality>(*world, who, potential),
                                     std::make_unique<ContactEnergy>(*world, who, reading)));
}

int closing(lua_State* L, const ClosingEnergy::Options& usual) {
  Table options(L, 1);
  const auto [world, who] = read_subject(options);
  const auto reading = read_closing_options(options, usual);
  options.done();
  return push_energy(L, world, std::make_unique<ClosingEnergy>(who, reading));
}

int autograsp_quality(lua_State* L) { return closing(L, {}); }
int strict_autograsp(lua_State* L) {
  return closing(L, {.nothing = 1e8, .approach = 0.03, .palm = true});
}

int guided_autograsp_quality(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_subject(options);
  GuidedClosingEnergy::Options reading{.contacts = read_contacts(options)};
  reading.facing = read_facing(options, Facing::away);
  reading.volume_weight = options.number("volume_weight", reading.volume_weight);
  reading.near = options.number("near", reading.near);
  reading.min_contacts = options.integer("min_contacts", reading.min_contacts);
  options.done();
  return push_energy(L, world, std::make_unique<GuidedClosingEnergy>(*world, who, reading));
}

int compliant(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_subject(options);
  CompliantEnergy::Options reading;
  reading.approach = options.number("approach", reading.approach);
  reading.min_epsilon = options.number("min_epsilon", reading.min_epsilon);
  options.done();
  return push_energy(L, world, std::make_unique<CompliantEnergy>(who, reading));
}

// (options) -> a function: stdlib/plan/dynamic_energy.lua
int make_dynamic(lua_State* L) {
  push_packed(L, "plan.dynamic_energy");
  lua_pushvalue(L, 1);
  protected_call(L, 1, 1);
  return 1;
}

int dynamic(lua_State* L) {
  lua_settop(L, 1);
  lua_pushcfunction(L, guarded<make_dynamic>);
  lua_pushvalue(L, 1);
  protected_call(L, 1, 1);
  lua_pushliteral(L, "hand");
  lua_rawget(L, 1);
  const auto* hand = to<RobotHandle>(L, -1);
  if (!hand) fail("{}: hand: expected a robot, got {}", subject(L), described(L, -1));
  return push_energy(L, hand->world, std::make_unique<EnergyFunction>(script_number(L, 2)));
}

// --- constraints ---

int approach_cone(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_hand(options);
  const Eigen::Vector3d axis = options.vec3("axis");
  const double angle = options.number("angle", 0);
  options.done();
  return push_energy(L, world, approach_cone_energy(who.hand, axis, angle));
}

int keep_out(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_hand(options);
  const Pose pose = options.pose("pose", Pose{});
  const Eigen::Vector3d low = options.vec3("low"), high = options.vec3("high");
  options.done();
  return push_energy(L, world, keep_out_energy(who.hand, pose, low, high));
}

int clearance(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_subject(options);
  const double distance = options.number("distance");
  options.done();
  return push_energy(L, world, clearance_energy(who, distance));
}

int reach(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_hand(options);
  const Eigen::Vector3d point = options.vec3("point");
  const double radius = options.number("radius");
  options.done();
  return push_energy(L, world, reach_energy(who.hand, point, radius));
}

int penetration(lua_State* L) {
  Table options(L, 1);
  const auto [world, who] = read_hand(options);
  const int points = options.integer("points", 64);
  options.done();
  return push_energy(L, world, penetration_energy(*world, who.hand, points));
}

// --- trees of terms ---

}  // namespace

// a term, or a function used as one; all share the world of the first term
EnergyPtr read_energy(lua_State* L, int index, WorldPtr& world) {
  if (lua_type(L, index) == LUA_TFUNCTION)
    return std::make_unique<EnergyFunction>(script_number(L, index));
  const auto* handle = to<EnergyHandle>(L, index);
  if (!handle) fail_expected({L, {}, ""}, "an energy, or a function that gives a number", index);
  if (world && handle->world && world != handle->world)
    fail("{}: the energies belong to two worlds", subject(L));
  if (handle->world) world = handle->world;
  return handle->energy->clone();
}

namespace {

int add(lua_State* L) {
  WorldPtr world;
  std::vector<EnergySum::Term> terms;
  terms.push_back({1, read_energy(L, 1, world)});
  terms.push_back({1, read_energy(L, 2, world)});
  return push_energy(L, world, std::make_unique<EnergySum>(std::move(terms)));
}

int multiply(lua_State* L) {
  const int number = lua_type(L, 1) == LUA_TNUMBER ? 1 : 2;
  WorldPtr world;
  std::vector<EnergySum::Term> terms;
  const double weight = check_number(L, number, "weight");
  terms.push_back({weight, read_energy(L, 3 - number, world)});
  return push_energy(L, world, std::make_unique<EnergySum>(std::move(terms)));
}

int within(lua_State* L) {
  const auto& handle = self<EnergyHandle>(L);
  const double low = given(L, 2) ? check_number(L, 2, "low") : -infinite;
  const double high = given(L, 3) ? check_number(L, 3, "high") : infinite;
  return push_energy(L, handle.world,
                     std::make_unique<EnergyWithin>(handle.energy->clone(), low, high));
}

int call(lua_State* L) {
  const auto& handle = self<EnergyHandle>(L);
  if (!handle.world) fail("energy: it consists only of a function: call that directly");
  const CallingState calling(L);
  const auto energy = handle.energy;  // a function may drop the last reference
  const auto world = handle.world;
  return push_unbounded(L, energy->value(*world));
}

const char* energy_text(const EnergyHandle& x) {
  return x.energy->any_thread() ? "energy" : "energy with a function of a script";
}

}  // namespace

static const Entry energy_functions[] = {
    {"contact", guarded<contact>, R"(
Distance and orientation of the hand's virtual contacts relative to the object: the mean of distance [mm] +
normal_weight (1 - cosine of the angle). Does not close the hand: the fastest energy.
@param options table  the hand, the object and how they are rated
@option hand robot  hand that grasps
@option object body  object that is grasped
@option contacts? "preset"|"live" = "preset"  preset: virtual contacts of the hand; live: the nearest point of each link
@option normal_weight? number [mm, >= 0] = 50  weight of the angle
@option facing? "nearest"|"surface"|"away" = "nearest"  what the normal is compared with: the direction to the nearest point, the surface there, or the direction away from it
@return energy
@effect reads
> e = clench.energy.contact {hand = hand, object = flask}
> e() > 0  --> true
> e2 = e + 0.5 * clench.energy.penetration {hand = hand}
> e2() == e()  --> true
> clench.energy.contact {hand = hand}  --> error: object: expected a body, got nothing
> clench.energy.contact {hand = hand, object = hand.base}  --> error: the object is a part of a robot)"},
    {"potential_quality", guarded<potential_quality>, R"(
Grasp quality of the virtual contacts as if they touched, with larger weights for nearer ones: minus epsilon of their forces (with
`torques`, of their wrenches). 1 if fewer than min_count are near and face the object, or if they do not resist all directions.
@param options table  the hand, the object and how they are rated
@option hand robot  hand that grasps
@option object body  object that is grasped
@option contacts? "preset"|"live" = "preset"  preset: virtual contacts of the hand; live: the nearest point of each link
@option reach? number [m, > 0] = 0.05  contacts farther away do not count
@option min_count? integer [>= 1] = 3  smallest number of contacts that are near
@option torques? boolean = false  true: of wrenches, not of forces
@return energy
@effect reads
> clench.energy.potential_quality {hand = hand, object = flask}() <= 1  --> true)"},
    {"guided_potential_quality", guarded<guided_potential_quality>, R"(
potential_quality if that is at most 0, otherwise contact, which guides the search there.
@param options table  the hand, the object and how they are rated
@option hand robot  hand that grasps
@option object body  object that is grasped
@option contacts? "preset"|"live" = "preset"  preset: virtual contacts of the hand; live: the nearest point of each link
@option normal_weight? number [mm, >= 0] = 50  weight of the angle
@option facing? "nearest"|"surface"|"away" = "nearest"  what the normal is compared with: the direction to the nearest point, the surface there, or the direction away from it
@option reach? number [m, > 0] = 0.05  contacts farther away do not count
@option min_count? integer [>= 1] = 3  smallest number of contacts that are near
@option torques? boolean = false  true: of wrenches, not of forces
@return energy
@effect reads
> clench.energy.guided_potential_quality {hand = hand, object = flask}() < 1000  --> true)"},
    {"autograsp_quality", guarded<autograsp_quality>, R"(
Closes the hand, and opens it again: minus (volume_weight * volume + epsilon_weight * epsilon) of the grasp; with
`tasks`, also minus task_weight times the largest multiple of all these wrenches that the grasp resists.
@param options table  the hand, the object and how they are rated
@option hand robot  hand that grasps
@option object body  object that is grasped
@option volume_weight? number [>= 0] = 30  weight of the volume
@option epsilon_weight? number [>= 0] = 100  weight of epsilon
@option tasks? number[][] [N and N m]  wrenches {fx, fy, fz, tx, ty, tz} along the axes of the object, about its center of mass
@option task_weight? number [>= 0]  weight of the tasks, 1 by default
@option edges? integer|"exact" [3 to 1000] = 8  of the friction pyramids; exact: round cones
@return energy
@effect reads
> e = clench.energy.autograsp_quality {hand = hand, object = flask, volume_weight = 0, epsilon_weight = 1}
> math.abs(e() + grasp:quality "epsilon") < 1e-6  --> true)"},
    {"guided_autograsp_quality", guarded<guided_autograsp_quality>, R"(
contact and, if two virtual contacts are near the object and face it, minus volume_weight times the volume of the
closed grasp. The default reproduces the numbers of GraspIt!, in which the angle has the wrong sign; `facing = "nearest"` is the
correct one.
@param options table  the hand, the object and how they are rated
@option hand robot  hand that grasps
@option object body  object that is grasped
@option contacts? "preset"|"live" = "preset"  preset: virtual contacts of the hand; live: the nearest point of each link
@option facing? "nearest"|"surface"|"away" = "away"  what the normal is compared with: the direction to the nearest point, the surface there, or the direction away from it
@option volume_weight? number [>= 0] = 1000  weight of the volume
@option near? number [m, > 0] = 0.02  such contacts are near
@option min_contacts? integer = 4  smallest number of contacts of a closed grasp that counts
@return energy
@effect reads
> clench.energy.guided_autograsp_quality {hand = hand, object = flask}() < 1000  --> true)"},
    {"strict_autograsp", guarded<strict_autograsp>, R"(
autograsp_quality after an approach of 30 mm that ends at the first contact; if the base then touches nothing, the hand stays
at its start. 1e8 if the grasp has no quality.
@param options table  the hand, the object and how they are rated
@option hand robot  hand that grasps
@option object body  object that is grasped
@option volume_weight? number [>= 0] = 30  weight of the volume
@option epsilon_weight? number [>= 0] = 100  weight of epsilon
@option tasks? number[][] [N and N m]  wrenches {fx, fy, fz, tx, ty, tz} along the axes of the object, about its center of mass
@option task_weight? number [>= 0]  weight of the tasks, 1 by default
@option edges? integer|"exact" [3 to 1000] = 8  of the friction pyramids; exact: round cones
@return energy
@effect reads
> clench.energy.strict_autograsp {hand = hand, object = flask}() < 0  --> true)"},
    {"compliant", guarded<compliant>, R"(
For hands with springs: approaches until the first touch along the approach direction, closes, and computes the balance of
contacts and joints at full effort: -200 + the unbalanced force [N]; 1 if a finger continues to move, fewer than two touch, or epsilon is below
min_epsilon.
@param options table  the hand, the object and how they are rated
@option hand robot  hand that grasps
@option object body  object that is grasped
@option approach? number [m, > 0] = 0.2  longest travel to the first touch
@option min_epsilon? number = 0.05  smallest epsilon
@return energy
@effect reads
> clench.energy.compliant {hand = hand, object = flask}() <= 1  --> true)"},
    {"dynamic", guarded<dynamic>, R"(
Result of shaking the closed hand in simulation: minus the sum over six directions of the fraction of the time that the object was held
in study.shake, down to -6; if the closed hand is not in force closure, or loses the object before the shaking, 1 + contact, which guides the search. It runs on
one thread, and takes some tenths of a second if the hand holds something.
@param options table  the hand and the object
@option hand robot  hand that grasps
@option object body  object that is grasped
@option shake? table  options of study.shake; 0.5 s along each direction, 0.3 s of grip and of rest by default
@option contacts? "preset"|"live" = "preset"  contacts of `contact`, which leads there
@return energy
@effect reads
> e = clench.energy.dynamic {hand = hand, object = flask, shake = {seconds = 0.1}}
> e(), e.any_thread  --> -6.0, false
> clench.energy.dynamic {hand = hand, object = flask, shake = {secs = 1}}()  --> error: unknown key 'secs')"},
    {"approach_cone", guarded<approach_cone>, R"(
Angle by which the hand's approach direction deviates from an axis, beyond a limit [rad]: grasps from above, or from one side.
@param options table  the hand and the cone
@option hand robot  hand that approaches
@option axis vec3  axis of the cone, in the world
@option angle? number [rad] = 0  half of the angle of the cone
@return energy
@effect reads
> d = hand.approach.direction
> clench.energy.approach_cone {hand = hand, axis = d}() < 1e-9  --> true
> clench.energy.approach_cone {hand = hand, axis = -d, angle = 1}() - (math.pi - 1) < 1e-9  --> true)"},
    {"keep_out", guarded<keep_out>, R"(
Penetration depth of the hand's bounding boxes in a forbidden box [mm].
@param options table  the hand and the box
@option hand robot  hand that stays out
@option low vec3 [m]  lowest corner, along the axes of the pose
@option high vec3 [m]  highest corner
@option pose? pose  of the box, that of the world by default
@return energy
@effect reads
> clench.energy.keep_out {hand = hand, low = {9, 9, 9}, high = {10, 10, 10}}()  --> 0.0)"},
    {"clearance", guarded<clearance>, R"(
Shortfall of the hand's distance to everything but its object and itself, below a limit [mm].
@param options table  the hand, the object and the distance
@option hand robot  hand that keeps the distance
@option object body  object that is grasped
@option distance number [m, >= 0]  smallest distance
@return energy
@effect reads
> clench.energy.clearance {hand = hand, object = flask, distance = 0.01}()  --> 0.0)"},
    {"reach", guarded<reach>, R"(
Distance of the hand's approach point from a point, beyond a radius [mm].
@param options table  the hand and the ball
@option hand robot  hand that stays within reach
@option point vec3 [m]  center of the ball, in the world
@option radius number [m, >= 0]  radius of the ball
@return energy
@effect reads
> clench.energy.reach {hand = hand, point = hand.approach.point, radius = 0.1}()  --> 0.0)"},
    {"penetration", guarded<penetration>, R"(
Penetration depth of the hand in colliding bodies, measured at points on its bodies, summed over the pairs of bodies [mm]; 0 only if
nothing collides. If no point lies inside, the depth given by `world:penetration` is used. A search with this term and `collisions = false` may cross states that collide.
@param options table  the hand and the points
@option hand robot  hand that may collide
@option points? integer [1 to 10000] = 64  number of points on each body
@return energy
@effect reads
> clench.energy.penetration {hand = hand}()  --> 0.0)"},
};

static const Entry energy_fields[] = {
    {"any_thread", getter<[](const EnergyHandle& x) { return x.energy->any_thread(); }>, R"(
Does it consist only of the engine's terms? A term with a function of a script runs on the script's thread, and in its world.
@type boolean
> e = clench.energy.contact {hand = hand, object = flask}
> e.any_thread, (e + function() return 1 end).any_thread  --> true, false)"},
};

static const Entry energy_methods[] = {
    {"within", guarded<within>, R"(
The same term, clamped to at least `low` and at most `high`; nil: no such bound.
@param low? number  lower bound
@param high? number  upper bound
@return energy
@effect reads
> clench.energy.contact {hand = hand, object = flask}:within(nil, 1)() <= 1  --> true)"},
};

static const Entry energy_operators[] = {
    {"__add", guarded<add>, ""},
    {"__mul", guarded<multiply>, ""},
    {"__call", guarded<call>, ""},
    {"__tostring", method<energy_text>, ""},
};

const Library energy_library{
    .name = "clench.energy",
    .doc =
        "Objective functions of searches. Each function makes an energy of a hand and an object: "
        "`e()` returns its value in their present state. Energies are added and weighted, `a + "
        "0.3 * b`, functions of a script among them. Distances count in millimeters, so that the "
        "numbers are those of GraspIt!.",
    .functions = energy_functions};

const Class energy_class{.name = "energy",
                         .variable = "energy",
                         .doc =
                             "A function that rates the pose and posture of a hand relative to an "
                             "object, made by `clench.energy`.",
                         .fields = energy_fields,
                         .methods = energy_methods,
                         .operators = energy_operators};

}  // namespace clench
