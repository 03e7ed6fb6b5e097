#include "clench/base/text.h"
#include "clench/dynamics/contact/overlap.h"
#include "clench/dynamics/mechanics.h"
#include "clench/dynamics/stepper.h"
#include "clench/script/bind/dynamics/control.h"
#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"

namespace clench {

static double check_time(lua_State* L, int i, const char* name, double least) {
  const double time = check_number(L, i, name);
  if (!(time >= least && time <= duration_rule.max))
    fail("{}: {}: expected a time from {} to {} s, got {}", subject(L), name, least,
         duration_rule.max, time);
  return time;
}

// --- time ---

// Warns of unexpected events of a run, once each.
static void tell_trouble(lua_State* L, const World& world, const StepReport& before) {
  static const char overlaps = 0, failures = 0;
  if (!world.dynamics()) return;
  const StepReport& report = world.dynamics()->report;
  if (report.overlaps > before.overlaps) {
    std::vector<BodyPair> pairs;
    for (const Manifold& m : world.dynamics()->manifolds)
      if (m.clearance == 0) pairs.emplace_back(m.a, m.b);
    const std::string which =
        pairs.empty() ? "overlapped for a time" : "overlap (" + describe(world, pairs) + ")";
    warn_once(L, &overlaps,
              fmt::format("{}: bodies {}; they are pushed apart slowly; world.report.overlaps "
                          "counts them; overlaps deeper than {:.3g} m remain",
                          subject(L), which, deepest_parted * world.contact_threshold()));
  }
  if (report.failures > before.failures)
    warn_once(L, &failures,
              fmt::format("{}: in some steps contacts, limits and motors contradict each other, "
                          "and the nearest solution was used; world.report.failures counts them",
                          subject(L)));
}

// Parts of the world that ODE does not simulate; empty if there are none.
static std::vector<std::string> lost_by_ode(const World& world) {
  std::vector<std::string> out;
  const auto add = [&](bool lost, const char* what, const std::string& name) {
    if (lost) out.push_back(fmt::format("{} of '{}'", what, excerpt(name)));
  };
  for (const auto id : world.robots())
    add(!world.robot(id).joint_tendons.empty(), "the joint tendons", world.robot(id).name);
  for (const auto id : world.bodies()) {
    const Body& body = world.body(id);
    add(body.free_friction != 0, "free_friction", body.name);
    add(body.free_armature != 0, "free_armature", body.name);
  }
  return out;
}

// Warns once per script.
static void warn_of_ode(lua_State* L, const World& world) {
  static const char lost = 0;
  if (world.dynamic_settings().engine != DynamicsEngine::ode) return;
  if (const auto parts = lost_by_ode(world); !parts.empty())
    warn_once(
        L, &lost,
        fmt::format("{}: the engine \"ode\" does not simulate {}", subject(L), name_list(parts)));
}

static int run(lua_State* L) {
  const WorldPtr world = self<WorldHandle>(L).world;
  const double duration = check_time(L, 2, "seconds", 0);
  const StepReport before = world->dynamics() ? world->dynamics()->report : StepReport{};
  warn_of_ode(L, *world);
  if (push_hooks(L, world, false))
    run_with_hooks(L, world, duration);
  else
    Stepper(*world).run(duration);
  tell_trouble(L, *world, before);
  return 0;
}

// steps made within a run would be unknown to it
static void check_not_running(lua_State* L) {
  if (!push_hooks(L, self<WorldHandle>(L).world, false)) return;
  lua_getfield(L, -1, "runs");
  if (lua_toboolean(L, -1))
    fail("{}: the world is already running: functions called during a run cannot step it",
         subject(L));
  lua_pop(L, 2);
}

static int move_bodies(lua_State* L) {
  check_not_running(L);
  const double dt = check_time(L, 2, "dt", time_step_rule.min);
  call_observers(L, self<WorldHandle>(L).world);  // at the start, before the first step
  return push(L, Stepper(world_of(L)).move(dt));
}

static int solve_velocities(lua_State* L) {
  check_not_running(L);
  const double h = check_time(L, 2, "h", 1e-12);
  Stepper(world_of(L)).solve(h);
  call_observers(L, self<WorldHandle>(L).world);
  return 0;
}

static void set_time_step(const WorldHandle& x, double step) {
  DynamicSettings settings = x.world->dynamic_settings();
  settings.step = step;
  x.world->set_dynamic_settings(std::move(settings));
}

static int get_report(lua_State* L) {
  const DynamicState* state = world_of(L).dynamics();
  const StepReport report = state ? state->report : StepReport{};
  return push_record(L, {{"steps", lua_Integer{report.steps}},
                         {"impacts", lua_Integer{report.impacts}},
                         {"iterations", lua_Integer{report.iterations}},
                         {"fallbacks", lua_Integer{report.fallbacks}},
                         {"failures", lua_Integer{report.failures}},
                         {"overlaps", lua_Integer{report.overlaps}},
                         {"residual", report.residual},
                         {"max_residual", report.max_residual},
                         {"contacts", report.contacts}});
}

static int get_momentum(lua_State* L) {
  const Momentum m = momentum(world_of(L));
  return push_record(L, {{"linear", m.linear}, {"angular", m.angular}});
}

static int get_energy(lua_State* L) {
  const MechanicalEnergy e = mechanical_energy(world_of(L));
  return push_record(L, {{"kinetic", e.kinetic}, {"potential", e.potential}});
}

// average contacts of bodies on links, as a table by link
static int average_contacts(lua_State* L) {
  const World& world = world_of(L);
  const auto bodies = check_bodies(L, 2, "links", self<WorldHandle>(L).world);
  const DynamicState* state = world.dynamics();
  struct Sum {
    Id<Body> body;
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), point = Eigen::Vector3d::Zero();
    double pressure = 0;
    int count = 0;
  };
  std::vector<Sum> sums;
  for (const auto id : bodies) {
    Sum sum{.body = id};
    if (state)
      for (const Manifold& m : state->manifolds) {
        if (m.a != id && m.b != id) continue;
        const Pose& X_WA = world.pose(m.a);
        for (const ManifoldPoint& p : m.points) {
          const Eigen::Vector3d force = X_WA.rotation * p.force;
          const double pressure = p.force.dot(p.normal);
          if (pressure <= 0) continue;
          sum.force += m.b == id ? force : Eigen::Vector3d(-force);
          sum.point += pressure * (X_WA * p.p_a);
          sum.pressure += pressure;
          ++sum.count;
        }
      }
    if (sum.count > 0) sums.push_back(sum);
  }
  return push_list_of(L, sums, [&](const Sum& sum) {
    push_record(L, {{"link", BodyHandle{self<WorldHandle>(L).world, sum.body}},
                    {"force", sum.force},
                    {"point", Eigen::Vector3d(sum.point / sum.pressure)},
                    {"count", sum.count}});
  });
}

// --- solver settings ---

static constexpr Word<DynamicsEngine> engines[] = {{"clench", DynamicsEngine::clench},
                                                   {"ode", DynamicsEngine::ode}};
static constexpr Word<FrictionCone> cones[] = {{"round", FrictionCone::round},
                                               {"pyramid", FrictionCone::pyramid}};

static void read_settings(Table& table, DynamicSettings& settings) {
  settings.step = table.number("time_step", settings.step);
  settings.engine = table.choice("engine", engines, settings.engine);
  settings.cone = table.choice("cone", cones, settings.cone);
  settings.cone_edges = table.integer("edges", settings.cone_edges);
  if (settings.cone_edges < 4 || settings.cone_edges > 64 || settings.cone_edges % 2 != 0)
    fail("{}: edges: expected an even number from 4 to 64, got {}", table.subject(),
         settings.cone_edges);
  table.done();
}

DynamicSettings read_dynamic_settings(Table& options) {
  DynamicSettings settings;
  if (options.push("dynamics") != LUA_TNIL) {
    Table table(options.state(), lua_gettop(options.state()), options.what("dynamics").text());
    read_settings(table, settings);
  }
  lua_pop(options.state(), 1);
  return settings;
}

static int get_dynamics(lua_State* L) {
  const DynamicSettings& settings = world_of(L).dynamic_settings();
  return push_record(L, {{"time_step", settings.step},
                         {"engine", word_of(settings.engine, engines)},
                         {"cone", word_of(settings.cone, cones)},
                         {"edges", settings.cone_edges}});
}

static int set_dynamics(lua_State* L) {
  DynamicSettings settings = world_of(L).dynamic_settings();
  Table table(L, 2);
  read_settings(table, settings);
  world_of(L).set_dynamic_settings(std::move(settings));
  return 0;
}

static const Entry world_dynamics_fields[] = {
    {"time", getter<[](const WorldHandle& x) { return x.world->time(); }>, R"(
Simulation time.
@type number  [s]
> world.time  --> 0.0)"},
    {"time_step", getter<[](const WorldHandle& x) { return x.world->dynamic_settings().step; }>, R"(
Length of the steps of `run`; from 1e-7 to 1.
@type number  [s]
> world.time_step  --> 0.001
> world.time_step = 0  --> error: time step)",
     setter<set_time_step>},
    {"dynamics", guarded<get_dynamics>, R"(
Solver settings. Returns a copy; setting a table changes the keys that it contains. `engine`: "clench", or "ode", which solves the same
contacts with the library ODE, at most 1,000 points per step; `cone`: friction cones are "round", or a "pyramid" of `edges` edges, of which each group of
touching bodies has at most 6,000; more is an error of the kind "limit".
@type {time_step: number, engine: string, cone: string, edges: integer}
> world.dynamics = {engine = "ode"}
> world.dynamics.engine, world.dynamics.time_step  --> ode, 0.001
> world.dynamics = {engine = "odee"}  --> error: did you mean 'ode'?)",
     guarded<set_dynamics>},
    {"report", guarded<get_report>, R"(
Statistics of steps: their number, those that ended early because bodies collided (`impacts`), the effort of the solver
(`iterations`; `fallbacks`, groups of touching bodies that needed its slow methods, and `failures`, groups that it did not solve to 1e-9 m/s, or 1e-8 m/s for bodies at rest),
overlapping pairs (`overlaps`), points that touched in the last step, and the residuals of the solutions
as velocities [m/s].
@type {steps: integer, impacts: integer, iterations: integer, fallbacks: integer, failures: integer, overlaps: integer, contacts: integer, residual: number, max_residual: number}
> world.report.failures  --> 0)"},
};

static const Entry world_dynamics_methods[] = {
    {"run", guarded<run>, R"(
Simulates: all free bodies move under gravity, contacts and the motors of robots. Each step first moves bodies with
their present velocities, then finds contacts, then solves for new velocities. The simulation time advances by exactly the given time.
@param seconds number  [s]
@effect long
> world:run(0.01)
> world.time  --> 0.01
> world:run(-1)  --> error: expected a time from 0)"},
    {"move_bodies", guarded<move_bodies>, R"(
First half of a step: moves everything with its present velocity, until the time has passed or two approaching bodies
touch.
@param dt number  [s]
@return number passed  in (0, dt] [s]
@effect edits
> world:move_bodies(0.001)  --> 0.001)"},
    {"solve_velocities", guarded<solve_velocities>, R"(
Second half of a step: computes the velocities that result after contacts, forces, motors and limits have acted for the given time.
@param h number  what move_bodies gave [s]
@effect edits
> world:solve_velocities(world:move_bodies(0.001))
> world.report.steps  --> 1)"},
    {"clear_forces", method<[](const WorldHandle& x) {
       for (Load& load : x.world->edit_dynamics().loads) load = {};
     }>,
     R"(
Clears the forces and torques that `apply_force` and `apply_torque` have set for the next step.
@effect edits
> flask:apply_force({0, 0, 1})
> world:clear_forces()
> world.gravity = {0, 0, 0}
> world:run(0.001)
> flask.velocity.linear  --> (0, 0, 0))"},
    {"momentum", guarded<get_momentum>, R"(
Total momentum of all objects and robots; the angular momentum is about the origin of the world.
@return {linear: vec3, angular: vec3}  [kg m/s], [kg m^2/s]
@effect reads
> world:momentum().linear  --> (0, 0, 0))"},
    {"energy", guarded<get_energy>, R"(
Total energy of all objects and robots: kinetic, and potential relative to the origin of the world, including springs.
@return {kinetic: number, potential: number}  [J]
@effect reads
> world:energy().kinetic  --> 0.0)"},
    {"average_contacts", guarded<average_contacts>, R"(
Resultant contact force on each of the given bodies in the last step, and its center. Bodies on which nothing
presses are left out.
@param links body|body[]  link or links whose contacts are averaged
@return {link: body, force: vec3, point: vec3, count: integer}[]  [N], [m]
@effect reads
> #world:average_contacts(hand)  --> 0)"},
};

const Class world_dynamics_class{
    .name = "world_dynamics",
    .variable = "world",
    .doc = "Dynamics of a world: time, steps, momentum, and contact forces.",
    .fields = world_dynamics_fields,
    .methods = world_dynamics_methods,
    .parent = &world_control_class};

}  // namespace clench
