#include "clench/script/bind/dynamics/control.h"

#include <cmath>
#include <set>

#include "clench/dynamics/stepper.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/packed.h"

namespace clench {

namespace {

// owner of the hooks, and events already reported to its listeners
struct Hooks {
  std::weak_ptr<World> world;
  std::set<std::pair<Id<Body>, Id<Body>>> touching;
  std::set<std::pair<Id<Robot>, int>> at_limit;  // DOF + 1, negative at the lower limit
};

// state of a running world
struct Stepping {
  WorldPtr world;
  Stepper stepper;
  explicit Stepping(WorldPtr of) : world(std::move(of)), stepper(*world) {}
};
using SteppingPtr = std::shared_ptr<Stepping>;

const Class hooks_class{.name = "hooks", .variable = "hooks", .doc = ""};
const Class stepping_class{.name = "stepping", .variable = "stepping", .doc = ""};

const char hooks_key = 0;  // its address is the registry key of the tables of hooks

}  // namespace

template <>
inline constexpr const Class* script_class<Hooks> = &hooks_class;
template <>
inline constexpr const Class* script_class<SteppingPtr> = &stepping_class;

// the hooks of a table of hooks; null if their world no longer exists
static Hooks* hooks_in(lua_State* L, int table) {
  lua_rawgeti(L, table, 1);
  Hooks* hooks = to<Hooks>(L, -1);
  lua_pop(L, 1);
  return hooks && !hooks->world.expired() ? hooks : nullptr;
}

// removes the tables of worlds that no longer exist
static void drop_old(lua_State* L, int all) {
  for (lua_pushnil(L); lua_next(L, all); lua_pop(L, 1)) {
    if (hooks_in(L, lua_gettop(L))) continue;
    lua_pushvalue(L, -2);
    lua_pushnil(L);
    lua_rawset(L, all);
  }
}

bool push_hooks(lua_State* L, const WorldPtr& world, bool make) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &hooks_key) != LUA_TTABLE) {
    lua_pop(L, 1);
    if (!make) return false;
    lua_newtable(L);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &hooks_key);
  }
  const int all = lua_gettop(L);
  // another world may have had the same address
  if (lua_rawgetp(L, all, world.get()) == LUA_TTABLE)
    if (const Hooks* hooks = hooks_in(L, lua_gettop(L)); hooks && hooks->world.lock() == world) {
      lua_remove(L, all);
      return true;
    }
  lua_pop(L, 1);
  if (make) {
    drop_old(L, all);
    lua_newtable(L);
    push_object(L, Hooks{.world = world, .touching = {}, .at_limit = {}});
    lua_rawseti(L, -2, 1);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, all, world.get());
  }
  lua_remove(L, all);
  return make;
}

// (stepping, end) -> was a step made?
static int step(lua_State* L) {
  const SteppingPtr stepping = check_object<SteppingPtr>(L, 1);
  return push(L, stepping->stepper.step(check_number(L, 2)));
}

static bool touches(const Manifold& m) { return !m.points.empty(); }

// appends to the list on top of the stack
static void append_event(lua_State* L, std::initializer_list<Field> event) {
  push_record(L, event);
  lua_rawseti(L, -2, static_cast<lua_Integer>(lua_rawlen(L, -2)) + 1);
}

static void tell_contacts(lua_State* L, const WorldPtr& world, Hooks& hooks) {
  std::set<std::pair<Id<Body>, Id<Body>>> now;
  for (const Manifold& m : world->dynamics()->manifolds) {
    if (!touches(m)) continue;
    now.insert({m.a, m.b});
    if (hooks.touching.contains({m.a, m.b})) continue;
    const Pose& X_WA = world->pose(m.a);
    Eigen::Vector3d point = Eigen::Vector3d::Zero(), force = Eigen::Vector3d::Zero();
    for (const ManifoldPoint& p : m.points) {
      point += X_WA * p.p_a / static_cast<double>(m.points.size());
      force += X_WA.rotation * p.force;
    }
    append_event(L, {{"kind", "contact"},
                     {"time", world->time()},
                     {"a", BodyHandle{world, m.a}},
                     {"b", BodyHandle{world, m.b}},
                     {"point", point},
                     {"force", force}});
  }
  for (const auto& [a, b] : hooks.touching) {
    if (now.contains({a, b}) || !world->alive(a) || !world->alive(b)) continue;
    append_event(L, {{"kind", "contact_lost"},
                     {"time", world->time()},
                     {"a", BodyHandle{world, a}},
                     {"b", BodyHandle{world, b}}});
  }
  hooks.touching = std::move(now);
}

static void tell_limits(lua_State* L, const WorldPtr& world, Hooks& hooks) {
  // a limit is reached within this distance, and left beyond it [rad or m]
  constexpr double reached = 1e-5, left = 1e-4;
  std::set<std::pair<Id<Robot>, int>> now;
  for (const auto id : world->robots()) {
    const Robot& robot = world->robot(id);
    const auto q = world->dofs(id);
    for (int d = 0; d < static_cast<int>(robot.dofs.size()); ++d)
      for (const int side : {0, 1}) {
        if (robot.endless[d]) continue;
        const std::pair key(id, side == 0 ? -(d + 1) : d + 1);
        const bool was = hooks.at_limit.contains(key);
        if (!(std::abs(q[d] - robot.limits[d][side]) < (was ? left : reached))) continue;
        now.insert(key);
        if (was) continue;
        append_event(L, {{"kind", "limit"},
                         {"time", world->time()},
                         {"robot", RobotHandle{world, id}},
                         {"dof", d + 1},
                         {"side", side == 0 ? "low" : "high"},
                         {"value", q[d]}});
      }
  }
  hooks.at_limit = std::move(now);
}

// (stepping, hooks) -> list of events since the last call
static int events(lua_State* L) {
  const SteppingPtr stepping = check_object<SteppingPtr>(L, 1);
  Hooks& hooks = check_object<Hooks>(L, 2);
  push_list(L);
  if (!stepping->world->dynamics()) return 1;
  tell_contacts(L, stepping->world, hooks);
  tell_limits(L, stepping->world, hooks);
  return 1;
}

// (hooks, world, seconds, stepping)
static int call_loop(lua_State* L) {
  lua_settop(L, 4);
  push_packed(L, "dynamics.control_loop");
  lua_insert(L, 1);
  lua_pushcfunction(L, guarded<step>);
  lua_pushcfunction(L, guarded<events>);
  protected_call(L, 6, 0);
  return 0;
}

void call_observers(lua_State* L, const WorldPtr& world) {
  if (!push_hooks(L, world, false)) return;
  push_packed(L, "dynamics.observe");
  lua_insert(L, -2);
  push_object(L, WorldHandle{world});
  protected_call(L, 2, 0);
}

void run_with_hooks(lua_State* L, const WorldPtr& world, double duration) {
  const int hooks = lua_gettop(L);
  lua_pushcfunction(L, guarded<call_loop>);
  lua_pushvalue(L, hooks);
  push_object(L, WorldHandle{world});
  push(L, duration);
  push_object(L, std::make_shared<Stepping>(world));
  protected_call(L, 4, 0);
}

}  // namespace clench
