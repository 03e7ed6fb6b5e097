#include "clench/script/bind/dynamics/control.h"
#include "clench/script/bind/dynamics/dynamics.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/log.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/packed.h"

namespace clench {

// (name, hooks, ...) -> a handle: a function of stdlib/dynamics/hooks.lua
static int call_hooks_module(lua_State* L) {
  take_packed_function(L, "dynamics.hooks");
  protected_call(L, lua_gettop(L) - 1, 1);
  return 1;
}

// the arguments of a method, with the world's hooks in place of the world, and the world after them
static int add_hook(lua_State* L, const char* name) {
  const auto& world = self<WorldHandle>(L).world;
  lua_settop(L, 3);
  lua_pushcfunction(L, guarded<call_hooks_module>);
  lua_pushstring(L, name);
  push_hooks(L, world, true);
  lua_pushvalue(L, 2);
  lua_pushvalue(L, 3);
  lua_pushvalue(L, 1);
  protected_call(L, 5, 1);
  return 1;
}

static int on_step(lua_State* L) { return add_hook(L, "on_step"); }
static int spawn(lua_State* L) { return add_hook(L, "spawn"); }
static int on(lua_State* L) { return add_hook(L, "on"); }
static int log_quantities(lua_State* L) { return add_hook(L, "log"); }
static int record(lua_State* L) { return add_hook(L, "record"); }
static int push_state(lua_State* L) { return add_hook(L, "push"); }
static int pop_state(lua_State* L) { return add_hook(L, "pop"); }

static const Entry control_methods[] = {
    {"on_step", guarded<on_step>, R"(
Registers a function that is called while the world runs, before each step or at intervals: fn(world, dt), with dt the length of the
next step (an impact may cut it short) or, with an interval, the time until the next call [s]. Functions are called in the order of their registration; an error in one ends the run, and its message names the place. They belong to the world,
not to its clones or snapshots.
@param fn function  called after each step
@param options? table  how often
@option rate? number [Hz, > 0]  calls in a second of the world's time, at the first step at or after each multiple of 1 / rate; by default at each step
@return table handle  `remove()` ends it
@effect edits
> count = 0
> handle = world:on_step(function(world, dt) count = count + 1 end, {rate = 100})
> world:run(0.1)
> count  --> 10
> handle:remove()
> world:on_step(5)  --> error: world:on_step: expected a function, got 5)"},
    {"spawn", guarded<spawn>, R"(
Runs a function concurrently with the world, as a coroutine: fn(task). `task.wait(seconds)` returns after that time;
`task.wait_until(condition, timeout)` returns true as soon as the function `condition` returns true, or false after the timeout;
`task.wait_step()` returns before the next step. Tasks continue before steps, after the functions of on_step, in the order in which they were
spawned; an error in one ends the run. A yield without values waits for the next step; a yield of anything else is an error.
@param fn function  function that runs as a coroutine in the time of the world
@return table handle  `remove()` ends it; `status`: "waiting", "done", "failed" or "removed"
@effect edits
> task = world:spawn(function(task) task.wait(0.02) seen = world.time end)
> world:run(0.05)
> seen, task.status  --> 0.02, done)"},
    {"on", guarded<on>, R"(
Registers a function that is called after each step with an event: "contact", two bodies touch that did not before, fn {kind, time, a,
b, point, force}, with the middle of the contact [m] and the force on b [N]; "contact_lost", {kind, time, a, b}; "limit", a
DOF reaches an end of its range, {kind, time, robot, dof, side, value}, with its number and "low" or "high".
@param event "contact"|"contact_lost"|"limit"  name of the event
@param fn function  called at each such event
@return table handle  `remove()` ends it
@effect edits
> touched = {}
> handle = world:on("contact", function(e) touched[#touched + 1] = e.b.name end)
> world:run(0.01)
> #touched > 0  --> true
> world:on("contcat", print)  --> error: world:on: event must be 'contact', 'contact_lost' or 'limit', got 'contcat')"},
    {"log", guarded<log_quantities>, R"(
Records quantities while the world runs, from its first step on, at a rate in simulation time. `quantities` lists, in order: bodies, for
their position and velocity; robots, for their DOFs, velocities and efforts; "energy", "momentum", "contacts", "failures"; and, by name,
functions(world) that return a number, a boolean, a vector, or a list of numbers of constant length. The time is recorded first.
@param options table  what is noted, and how often
@option rate? number [Hz, > 0] = 100  rows in a second of the world's time
@option quantities table  bodies, robots and names in order, functions by their names
@return log log  `rows`, a list of {time, ...}; `columns`, their names; `save(path)`, as .csv or .npz; `remove()` ends it
@effect edits
> log = world:log {rate = 50, quantities = {flask, "energy", height = function() return flask.pose.position.z end}}
> world:run(0.1)
> #log.rows, log.columns[1], log.columns[2]  --> 6, time, flask.position.x
> log:save "build/flask.csv"
> world:log {quantities = {"enrgy"}}  --> error: did you mean 'energy'?)"},
    {"record", guarded<record>, R"(
Records a run of the world for films: its state at a fixed rate of simulation time.
@param options? table  how often
@option rate? number [Hz, > 0] = 30  states in a second of the world's time
@return recording recording  `times`; `save(path, options)`, see the guide; `remove()` ends it
@effect edits
> film = world:record {rate = 20}
> world:run(0.1)
> #film.times  --> 3
> film:save "film.avi"  --> error: expected a name that ends in .html, .gif, .mp4 or .png, got 'film.avi')"},
    {"push", guarded<push_state>, R"(
Saves the state of the world on top of its stack of states.
@return integer depth  how many lie there now
@effect edits
> world:push()  --> 1)"},
    {"pop", guarded<pop_state>, R"(
Restores the state that was pushed last, and removes it from the stack.
@return integer depth  how many are left
@effect edits
> before = world:hash()
> world:push()
> world:run(0.05)
> world:pop(), world:hash() == before  --> 0, true
> world:pop()  --> error: world:pop: the stack is empty)"},
};

const Class world_control_class{.name = "world_control",
                                .variable = "world",
                                .doc = "Functions of scripts that a running world calls.",
                                .methods = control_methods,
                                .parent = &world_settings_class};

}  // namespace clench
