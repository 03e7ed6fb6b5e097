#include "clench/script/bind/handles.h"

#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/watching.h"

namespace clench {

int push_world(lua_State* L, const WorldPtr& world) {
  world->context().watch(Progress(bar_of(L)));
  push_object(L, WorldHandle{world});
  add_owned<WorldHandle>(L, -1, world->bytes());
  return 1;
}

void add_owned_bodies(lua_State* L, int index, std::span<const Id<Body>> bodies) {
  const World& world = *to<WorldHandle>(L, index)->world;
  // size above which building the tree takes noticeable time
  constexpr size_t many_triangles = 100000;
  size_t bytes = 0;
  for (const auto id : bodies) {
    const Body& body = world.body(id);
    bytes += sizeof body + body.appearance.triangle_colors.size() * sizeof(Eigen::Vector3f);
    if (body.appearance.skin) bytes += body.appearance.skin->bytes();
    if (!body.shape) continue;
    bytes += body.shape->bytes();
    // built here, where it can be stopped, and not in the first query
    if (body.shape->mesh().triangles.size() > many_triangles) body.shape->tree(Progress(bar_of(L)));
  }
  add_owned<WorldHandle>(L, index, bytes);
}

Id<Body> find_link(const RobotHandle& robot, const std::string& name, const std::string& subject) {
  const std::string prefix = robot->name + "_";
  std::vector<std::string> names;
  for (int l = -1; l < static_cast<int>(robot->links.size()); ++l) {
    const auto id = robot->body_of(l);
    const std::string& full = robot.world->body(id).name;
    if (full == name || full == prefix + name) return id;
    const bool own = full.starts_with(prefix) && !name.starts_with(prefix);
    names.push_back(own ? full.substr(prefix.size()) : full);
  }
  fail("{}: robot '{}' has no link '{}'{}", subject, robot->name, name, instead_of(name, names));
}

int push(lua_State* L, const Bounds& bounds) {
  return push_record(L, {{"low", bounds.low}, {"high", bounds.high}});
}

int push_bodies(lua_State* L, const WorldPtr& world, const std::vector<Id<Body>>& ids) {
  return push_list_of(L, ids, [&](Id<Body> id) { push(L, BodyHandle{world, id}); });
}

int push_pairs(lua_State* L, const WorldPtr& world, const std::vector<BodyPair>& pairs) {
  return push_list_of(L, pairs, [&](const BodyPair& pair) {
    push_bodies(L, world, {pair.first, pair.second});
  });
}

static void check_world(lua_State* L, const WorldPtr& mine, const WorldPtr& theirs,
                        const std::string& name) {
  if (mine != theirs) fail("{}: '{}' belongs to another world", subject(L), name);
}

std::vector<Id<Body>> check_bodies(lua_State* L, int i, const char* name, const WorldPtr& world) {
  if (const auto* body = to<BodyHandle>(L, i)) {
    check_world(L, world, body->world, (*body)->name);
    return {body->id};
  }
  if (const auto* robot = to<RobotHandle>(L, i)) {
    check_world(L, world, robot->world, (*robot)->name);
    return world->bodies_of(robot->id);
  }
  if (lua_istable(L, i) && lua_rawlen(L, i) > 0) {
    std::vector<Id<Body>> out;
    for (lua_Integer k = 1; k <= static_cast<lua_Integer>(lua_rawlen(L, i)); ++k) {
      lua_rawgeti(L, i, k);
      if (lua_istable(L, -1))
        fail_expected({L, {}, name}, "bodies and robots in the list", lua_gettop(L));
      for (const auto id : check_bodies(L, lua_gettop(L), name, world)) out.push_back(id);
      lua_pop(L, 1);
    }
    return out;
  }
  fail_expected({L, {}, name}, "a body, a robot, or a list of at least one", i);
}

BodyHandle self_body(lua_State* L) {
  if (const auto* robot = to<RobotHandle>(L, 1)) return {robot->world, (*robot)->base};
  return self<BodyHandle>(L);
}

}  // namespace clench
