#include "clench/planning/search/run_together.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/planning/planning.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/getter.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/table.h"
#include "clench/script/lua/watching.h"

namespace clench {

namespace {

AnnealingSchedule read_schedule(lua_State* L, Table& options) {
  const int type = options.push("schedule");
  const int at = lua_gettop(L);
  if (type == LUA_TSTRING || type == LUA_TNIL) {
    const std::string name = type == LUA_TNIL ? "default" : std::string(string_at(L, at));
    lua_pop(L, 1);
    return annealing_schedule(name);
  }
  if (type != LUA_TTABLE) fail_expected(options.what("schedule"), "a name or a table", at);
  Table of(L, at, options.what("schedule").text());
  AnnealingSchedule s = annealing_schedule(of.string("like", "default"));
  s.neighbor_decay = of.number("neighbor_decay", s.neighbor_decay);
  s.error_decay = of.number("error_decay", s.error_decay);
  s.neighbor_dimensions = of.number("neighbor_dimensions", s.neighbor_dimensions);
  s.error_dimensions = of.number("error_dimensions", s.error_dimensions);
  s.neighbor_scale = of.number("neighbor_scale", s.neighbor_scale);
  s.error_scale = of.number("error_scale", s.error_scale);
  s.t0 = of.number("t0", s.t0);
  s.first_step = of.integer("first_step", s.first_step);
  of.done();
  lua_pop(L, 1);
  return s;
}

BestListOptions read_best(lua_State* L, Table& options, const World& world, Id<Body> object) {
  BestListOptions out;
  const double radius = world.body(object).max_radius();
  out.radius = radius > 0 ? radius : 1;
  options.push("best");
  Table of(L, lua_gettop(L), options.what("best").text());
  out.size = of.integer("size", out.size);
  out.distance = of.number("distance", out.distance);
  out.posture = of.boolean("posture", out.posture);
  out.max_energy = of.number("max_energy", out.max_energy);
  of.done();
  lua_pop(L, 1);
  return out;
}

// the hand and the object of the options, in the world that the search moves: theirs or its clone
HandAndObject read_who(Table& options, WorldPtr& world) {
  const auto* hand = options.object<RobotHandle>("hand");
  const auto* object = options.object<BodyHandle>("object");
  if (!hand || !object)
    fail("{}: {}: expected {}, got nothing", options.subject(), hand ? "object" : "hand",
         hand ? "a body" : "a robot");
  world = hand->world;
  if (const auto* given = options.object<WorldHandle>("world")) world = given->world;
  for (const WorldPtr& of : {hand->world, object->world})
    if (of->lineage() != world->lineage())
      fail("{}: hand and object belong to another world", options.subject());
  if (world->body(object->id).robot)
    fail("{}: object: '{}' is a part of a robot", options.subject(), (*object)->name);
  if (world->robot(hand->id).mounting)
    fail("{}: hand: '{}' is carried by another robot; plan for a hand that is not mounted",
         options.subject(), (*hand)->name);
  return {hand->id, object->id};
}

int make_annealing(lua_State* L) {
  Table options(L, 1);
  WorldPtr world;
  const HandAndObject who = read_who(options, world);
  SearchSpace space = read_space(L, options, *world, who);
  AnnealingOptions annealing;
  annealing.schedule = read_schedule(L, options);
  annealing.best = read_best(L, options, *world, who.object);
  annealing.seed = options.seed("seed", annealing.seed);
  annealing.collisions = options.boolean("collisions", annealing.collisions);
  annealing.max_tries = options.integer("max_tries", annealing.max_tries);
  options.push("energy");
  WorldPtr about;
  EnergyPtr energy = read_energy(L, lua_gettop(L), about);
  lua_pop(L, 1);
  options.done();
  if (about && about->lineage() != world->lineage())
    fail("{}: energy: it belongs to another world", options.subject());
  const CallingState calling(L);
  return push_object(
      L, AnnealingHandle{world, std::make_shared<Annealing>(*world, who, std::move(space),
                                                            std::move(energy), annealing)});
}

int check_steps(lua_State* L, int i, const char* name) {
  const int steps = check_int(L, i, name);
  if (steps < 0) fail("{}: {} must be >= 0, got {}", subject(L), name, steps);
  return steps;
}

int run_search(lua_State* L) {
  const auto search = self<AnnealingHandle>(L).search;
  const int steps = check_steps(L, 2, "steps");
  const Watching watching(L);
  const CallingState calling(L);
  return push(L, search->run(steps, watching.progress()));
}

int run_all(lua_State* L) {
  const What list{L, {}, "searches"};
  const int count = read_list_size(L, 1, list, "a list of searches");
  const auto steps = check_numbers(L, 2, "steps", count);
  const int threads = given(L, 3) ? check_int(L, 3, "threads") : 1;
  std::vector<std::shared_ptr<Annealing>> searches;
  std::vector<Share> shares;
  each_item(L, 1, list, "a list of searches", [&](int i, const What& what) {
    const auto* handle = to<AnnealingHandle>(L, i);
    if (!handle) fail_object(what, annealing_class, i);
    const double taken = steps[searches.size()];
    searches.push_back(handle->search);
    if (!(taken >= 0 && taken <= 1e9))
      fail("{}: steps[{}]: expected 0 to 1e9, got {}", subject(L), searches.size(), taken);
    shares.push_back({handle->search.get(), static_cast<int>(taken)});
  });
  const Watching watching(L);
  const CallingState calling(L);
  run_together(shares, threads, watching.progress());
  return push_list_of(L, shares, [L](const Share& share) { push(L, share.taken); });
}

int push_search_state(lua_State* L, const Annealing& search, const FoundState& found) {
  return push_record(L, {{"energy", [&] { push_unbounded(L, found.energy); }},
                         {"step", static_cast<double>(found.step)},
                         {"pose", found.state.X_RH},
                         {"dofs", found.state.dofs},
                         {"values", [&] { push_values(L, search.space(), found.values); }}});
}

int get_best(lua_State* L) {
  const Annealing& search = *self<AnnealingHandle>(L).search;
  return push_list_of(L, search.best().states(),
                      [&](const FoundState& found) { push_search_state(L, search, found); });
}

int get_values(lua_State* L) {
  const Annealing& search = *self<AnnealingHandle>(L).search;
  return push_values(L, search.space(), search.values());
}

int get_state(lua_State* L) {
  const Annealing& search = *self<AnnealingHandle>(L).search;
  return push_search_state(L, search,
                           {search.values(), search.space().state(search.values()), search.energy(),
                            search.counts().steps});
}

int get_counts(lua_State* L) {
  const AnnealingCounts& c = self<AnnealingHandle>(L).search->counts();
  return push_record(L, {{"steps", lua_Integer{c.steps}},
                         {"accepted", lua_Integer{c.accepted}},
                         {"improved", lua_Integer{c.improved}},
                         {"stuck", lua_Integer{c.stuck}},
                         {"in_collision", lua_Integer{c.in_collision}},
                         {"avoided", lua_Integer{c.avoided}},
                         {"outside", lua_Integer{c.outside}}});
}

int get_search_energy(lua_State* L) {
  return push_unbounded(L, self<AnnealingHandle>(L).search->energy());
}
int get_first(lua_State* L) {
  return push_unbounded(L, self<AnnealingHandle>(L).search->first_energy());
}

// {pose =, dofs =} of the hand, the pose in the object, as `best` lists them
HandState read_search_state(lua_State* L, int i, const Annealing& search) {
  Table of(L, i, subject(L) + ": state");
  const int count = static_cast<int>(search.world().dofs(search.who().hand).size());
  const HandState out{of.pose("pose"), of.vector("dofs", count)};
  of.has("energy"), of.has("step"), of.has("values");  // other fields of `best`
  of.done();
  return out;
}

int avoid(lua_State* L) {
  Annealing& search = *self<AnnealingHandle>(L).search;
  search.best().avoid(read_search_state(L, 2, search));
  return 0;
}

int go_to(lua_State* L) {
  Annealing& search = *self<AnnealingHandle>(L).search;
  const CallingState calling(L);
  search.go_to(search.space().values(read_search_state(L, 2, search)));
  return get_values(L);
}

std::string annealing_text(const AnnealingHandle& x) {
  return fmt::format("annealing after {} steps, energy {:.6g}", x.search->counts().steps,
                     x.search->energy());
}

}  // namespace

static const Entry annealing_functions[] = {
    {"annealing", guarded<make_annealing>, R"(
A chain of simulated annealing, run step by step: the search used by `clench.plan`. It moves the world's hand.
@param options table  the hand, the object, and the variables of the search
@option hand robot  hand that the search moves
@option object body  object that is grasped
@option energy energy|function  objective
@option world? world  a clone to move instead
@option position? "axis_angle"|"complete"|"ellipsoid"|"approach"|"fixed" = "axis_angle"  variables of the position; axis_angle: Tx Ty Tz theta phi alpha
@option posture? "eigengrasps"|"dofs"|"fixed" = "eigengrasps"  variables of the fingers
@option semi_axes? vec3 [m]  of the ellipsoid
@option limits? table  ranges by names of variables, {Tx = {min, max}}
@option jumps? table  longest jumps by names of variables
@option values? table  where variables begin, by their names, and stay when they are `fixed`
@option targets? table  {Tx = {value, confidence}} draw neighbors near them
@option fixed? string[]  names of variables that do not change
@option start? "default"|"hand" = "default"  hand: from where the hand is
@option variables? table  more variables, {name = {min =, max =, value =, jump =, circular =}}
@option schedule? string|table = "default"  "default", "loop", "modified", "strict" or "online", or {like =, t0 =, first_step =, ...}
@option seed? integer = 0  seed of the random numbers
@option collisions? boolean = true  false: states that collide are legal
@option max_tries? integer [>= 1] = 11  tries to find a legal neighbor
@option best? table  {size = 20, distance = 0.2, posture = true, max_energy =}
@return annealing
@effect reads
> search = clench.annealing {hand = hand, object = flask, energy = clench.energy.contact {hand = hand, object = flask}, seed = 1}
> search:run(100), search.counts.steps  --> 100, 100
> search.best[1].energy <= search.first_energy  --> true
> clench.annealing {hand = hand, object = flask, energy = 3}  --> error: expected an energy, or a function that gives a number
> clench.annealing {hand = hand, object = flask, energy = search.run, limits = {Txx = {0, 1}}}  --> error: no search variable 'Txx')"},
    {"run_annealings", guarded<run_all>, R"(
Runs several chains at once, each in a separate world; their results do not depend on the number of threads.
@param searches annealing[]  searches to advance
@param steps integer[]  one per chain
@param threads? integer  1 by default
@return integer[] taken  fewer than asked where no legal neighbor was found
@effect long
> energy = clench.energy.contact {hand = hand, object = flask}
> a = clench.annealing {world = world:clone(), hand = hand, object = flask, energy = energy, seed = 1}
> b = clench.annealing {world = world:clone(), hand = hand, object = flask, energy = energy, seed = 1}
> clench.run_annealings({a, b}, {50, 50}, 2)  --> {50, 50}
> a.energy == b.energy  --> true
> clench.run_annealings({a, a}, {5, 5})  --> error: need separate worlds)"},
};

static const Entry annealing_fields[] = {
    {"best", guarded<get_best>, R"(
The best distinct states visited: `energy`, `step`, `pose` of the hand in the object, `dofs`, and `values` of the variables
by name.
@type {energy: number, step: integer, pose: pose, dofs: number[], values: table}[]
> search = clench.annealing {hand = hand, object = flask, energy = clench.energy.contact {hand = hand, object = flask}}
> search:run(20)
> #search.best >= 1, #search.best[1].dofs  --> true, 12)"},
    {"state", guarded<get_state>, R"(
Present state of the chain, in the format of `best`; its energy is infinite if it begins in collision.
@type table
> search = clench.annealing {hand = hand, object = flask, energy = clench.energy.contact {hand = hand, object = flask}}
> search.state.energy == search.energy  --> true)"},
    {"values", guarded<get_values>, R"(
Values of its variables by name.
@type table
> search = clench.annealing {hand = hand, object = flask, energy = clench.energy.contact {hand = hand, object = flask}}
> search.values.Tz  --> 0.35)"},
    {"energy", guarded<get_search_energy>, R"(
Energy of the present state; infinite if it begins in collision.
@type number
> clench.annealing {hand = hand, object = flask, energy = function() return 2 end}.energy  --> 2.0)"},
    {"first_energy", guarded<get_first>, R"(
Energy of the initial state.
@type number
> clench.annealing {hand = hand, object = flask, energy = function() return 2 end}.first_energy  --> 2.0)"},
    {"counts", guarded<get_counts>, R"(
Counts of its steps: `steps`, `accepted`, `improved`; and of rejected neighbors: `in_collision`, `avoided`, `outside`
(their ranges); `stuck`: number of steps in which all attempts failed.
@type table
> search = clench.annealing {hand = hand, object = flask, energy = function() return 2 end}
> search:run(5)
> search.counts.steps  --> 5)"},
};

static const Entry annealing_methods[] = {
    {"run", guarded<run_search>, R"(
Takes steps, each to a legal neighbor that is accepted or not.
@param steps integer [>= 0]  steps to take at most
@return integer taken  fewer where 10,000 tries in a row found no legal neighbor
@effect long
> search = clench.annealing {hand = hand, object = flask, energy = function() return 2 end}
> search:run(3)  --> 3
> search:run(-1)  --> error: steps must be >= 0, got -1)"},
    {"avoid", guarded<avoid>, R"(
Avoids a state from now on: states similar to it are illegal.
@param state table  as `best` lists them; other fields of such an item are ignored
@option pose pose  of the hand, in the object
@option dofs number[] [rad or m]  of the hand
@option energy? number  ignored
@option step? integer  ignored
@option values? table  ignored
@effect edits
> search = clench.annealing {hand = hand, object = flask, energy = function() return 2 end}
> search:avoid(search.best[1])
> search:run(5), search.counts.avoided > 0  --> 5, true)"},
    {"go_to", guarded<go_to>, R"(
Sets a state, or the nearest one that its variables can represent.
@param state table  as `best` lists them; other fields of such an item are ignored
@like search:avoid
@return table values
@effect edits
> search = clench.annealing {hand = hand, object = flask, energy = function() return 2 end}
> search:go_to {pose = flask.pose:inverse() * hand.pose, dofs = hand.dofs}.alpha >= 0  --> true)"},
    {"reset", method<[](const AnnealingHandle& x) { x.search->reset_schedule(); }>, R"(
Restarts the schedule of temperatures.
@effect edits
> search = clench.annealing {hand = hand, object = flask, energy = function() return 2 end}
> search:reset()
> search.energy  --> 2.0)"},
    {"clear", method<[](const AnnealingHandle& x) { x.search->best().clear(); }>, R"(
Clears the list of the best states; avoided states remain avoided.
@effect edits
> search = clench.annealing {hand = hand, object = flask, energy = function() return 2 end}
> search:clear()
> #search.best  --> 0)"},
};

static const Entry annealing_operators[] = {{"__tostring", method<annealing_text>, ""}};

const Library annealing_library{.name = "clench", .doc = "", .functions = annealing_functions};

const Class annealing_class{.name = "annealing",
                            .variable = "search",
                            .doc = "A chain of simulated annealing, made by `clench.annealing`.",
                            .fields = annealing_fields,
                            .methods = annealing_methods,
                            .operators = annealing_operators};

}  // namespace clench
