#include "clench/script/bind/parcel.h"

#include "clench/base/error.h"
#include "clench/script/bind/grasp/grasps.h"
#include "clench/script/bind/handles.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/bind/world/meshes.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/push.h"

namespace clench {

static constexpr int max_depth = 100;

// (name) -> the class of the standard library, or nil
static int find_class(lua_State* L) {
  push_packed(L, "classes");
  lua_pushvalue(L, 1);
  lua_rawget(L, -2);
  return 1;
}

static void push_class(lua_State* L, const std::string& name) {
  lua_pushcfunction(L, find_class);
  lua_pushlstring(L, name.data(), name.size());
  protected_call(L, 1, 1);
}

// name of the class of the table at the index; "": not an object of the standard library
static std::string class_name_of(lua_State* L, int index) {
  if (!lua_getmetatable(L, index)) return {};
  const int metatable = lua_gettop(L);
  lua_pushliteral(L, "__name");
  std::string name;
  if (lua_rawget(L, metatable) == LUA_TSTRING) name = string_at(L, -1);
  bool is_class = false;
  if (!name.empty()) {
    push_class(L, name);
    is_class = lua_rawequal(L, -1, metatable);
  }
  lua_settop(L, metatable - 1);
  return is_class ? name : std::string();
}

// sets the class of the table on top; if the state does not know the class, the table stays plain
static void set_class(lua_State* L, const std::string& name) {
  push_class(L, name);
  if (lua_istable(L, -1))
    lua_setmetatable(L, -2);
  else
    lua_pop(L, 1);
}

Parcel::Parcel(lua_State* L, int index, const std::string& what) {
  Packing packing{L, {}};
  root_ = pack(packing, lua_absindex(L, index), what, 0);
}

WorldPtr Parcel::clone_of(Packing& packing, const WorldPtr& world) {
  WorldPtr& clone = packing.clones[world.get()];
  if (!clone) {
    clone = std::make_shared<World>(*world);
    worlds_.push_back(clone);
  }
  return clone;
}

Parcel::Node Parcel::pack(Packing& packing, int index, const std::string& what, int depth) {
  lua_State* L = packing.L;
  switch (lua_type(L, index)) {
    case LUA_TNIL:
      return {};
    case LUA_TBOOLEAN:
      return {static_cast<bool>(lua_toboolean(L, index))};
    case LUA_TNUMBER:
      if (lua_isinteger(L, index)) return {lua_tointeger(L, index)};
      return {lua_tonumber(L, index)};
    case LUA_TSTRING:
      return {std::string(string_at(L, index))};
    case LUA_TTABLE:
      return pack_table(packing, index, what, depth);
    case LUA_TUSERDATA:
      return pack_object(packing, index, what);
    default:
      fail("{}: a {} cannot be copied to another state", what, lua_typename(L, lua_type(L, index)));
  }
}

Parcel::Node Parcel::pack_table(Packing& packing, int index, const std::string& what, int depth) {
  lua_State* L = packing.L;
  if (depth == max_depth)
    fail("{}: lists in lists, more than {} deep, cannot be copied to another state", what,
         max_depth);
  if (!lua_checkstack(L, 4)) fail(ErrorKind::limit, "{}: too many values on Lua's stack", what);
  Fields fields;
  lua_pushnil(L);
  while (lua_next(L, index)) {
    const int key = lua_gettop(L) - 1;
    std::string where = what;
    if (lua_isinteger(L, key))
      where += fmt::format("[{}]", lua_tointeger(L, key));
    else if (lua_type(L, key) == LUA_TSTRING)
      where += std::string(".") + lua_tostring(L, key);
    Node name = pack(packing, key, where + " (its key)", depth + 1);
    Node value = pack(packing, key + 1, where, depth + 1);
    fields.emplace_back(std::move(name), std::move(value));
    lua_pop(L, 1);
  }
  return {std::move(fields), class_name_of(L, index)};
}

Parcel::Node Parcel::pack_object(Packing& packing, int index, const std::string& what) {
  lua_State* L = packing.L;
  const auto copied = [](auto value) {
    return Node{Object([value = std::move(value)](lua_State* to) { push_object(to, value); })};
  };
  if (const auto* v = to<Eigen::Vector3d>(L, index)) return copied(*v);
  if (const auto* pose = to<Pose>(L, index)) return copied(*pose);
  if (const auto* random = to<Random>(L, index)) return copied(*random);
  if (const auto* shape = to<ShapePtr>(L, index)) return copied(*shape);
  if (const auto* snapshot = to<SnapshotHandle>(L, index)) return copied(*snapshot);
  if (const auto* g = to<GraspHandle>(L, index)) return copied(GraspHandle{nullptr, g->grasp});
  if (const auto* list = to<GraspList>(L, index)) {
    GraspList alone;
    for (const GraspHandle& g : list->grasps) alone.grasps.push_back({nullptr, g.grasp});
    return copied(std::move(alone));
  }
  if (const auto* w = to<WorldHandle>(L, index))
    return {
        Object([world = clone_of(packing, w->world)](lua_State* to) { push_world(to, world); })};
  if (const auto* b = to<BodyHandle>(L, index))
    return copied(BodyHandle{clone_of(packing, b->world), b->id});
  if (const auto* r = to<RobotHandle>(L, index))
    return copied(RobotHandle{clone_of(packing, r->world), r->id});
  fail("{}: {} cannot be copied to another state", what, described(L, index));
}

void Parcel::unpack(lua_State* L, const Node& node) {
  struct Visitor {
    lua_State* L;
    const std::string& class_name;
    void operator()(std::monostate) const { lua_pushnil(L); }
    void operator()(bool b) const { lua_pushboolean(L, b); }
    void operator()(lua_Integer n) const { lua_pushinteger(L, n); }
    void operator()(double x) const { lua_pushnumber(L, x); }
    void operator()(const std::string& text) const { lua_pushlstring(L, text.data(), text.size()); }
    void operator()(const Fields& fields) const {
      if (!lua_checkstack(L, 4)) fail(ErrorKind::limit, "too many values on Lua's stack");
      lua_createtable(L, 0, 0);
      for (const auto& [key, value] : fields) {
        unpack(L, key);
        unpack(L, value);
        lua_rawset(L, -3);
      }
      if (!class_name.empty()) set_class(L, class_name);
    }
    void operator()(const Object& object) const { object(L); }
  };
  std::visit(Visitor{L, node.class_name}, node.value);
}

}  // namespace clench
