#include "clench/script/lua/lookup.h"

#include <algorithm>
#include <string>
#include <vector>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/stack.h"

namespace clench {

static void push_closure(lua_State* L, lua_CFunction function, const Entry& entry,
                         int max_arguments, const Class* kind, const Library* library) {
  lua_pushlightuserdata(L, const_cast<Entry*>(&entry));
  lua_pushlightuserdata(L, const_cast<Class*>(kind));
  lua_pushlightuserdata(L, const_cast<Library*>(library));
  lua_pushinteger(L, max_arguments);
  lua_pushcclosure(L, function, 4);
}

// what a script calls itself, as many arguments as its doc says
static void set_functions(lua_State* L, std::span<const Entry> entries, const Class* kind,
                          const Library* library = nullptr) {
  for (const Entry& entry : entries) {
    push_closure(L, entry.function, entry, max_arguments(entry), kind, library);
    lua_setfield(L, -2, entry.name);
  }
}

// what the lookup or Lua calls: getters, setters, operators
static void set_hidden(lua_State* L, std::span<const Entry> entries, const Class* kind,
                       bool setters = false, const Library* library = nullptr) {
  for (const Entry& entry : entries) {
    const lua_CFunction function = setters ? entry.setter : entry.function;
    if (!function) continue;
    push_closure(L, function, entry, -1, kind, library);
    lua_setfield(L, -2, entry.name);
  }
}

// --- lookup of members: upvalues are (fields' getters or setters, methods, fallback or nil,
// owner's name) ---

enum Lookup { in_fields = 1, in_methods = 2, in_fallback = 3, owner = 4 };

static std::vector<std::string> string_keys(lua_State* L, int upvalue) {
  std::vector<std::string> keys;
  if (!lua_istable(L, lua_upvalueindex(upvalue))) return keys;
  for (lua_pushnil(L); lua_next(L, lua_upvalueindex(upvalue)); lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) keys.emplace_back(string_at(L, -2));
  std::sort(keys.begin(), keys.end());
  return keys;
}

static int no_such_member(lua_State* L) {
  const std::string name = lua_tostring(L, lua_upvalueindex(owner));
  if (lua_type(L, 2) != LUA_TSTRING)
    fail("{}: expected a name of a field or method, got a {}", name, luaL_typename(L, 2));
  const std::string key(string_at(L, 2));
  auto known = string_keys(L, in_fields);
  for (auto& method : string_keys(L, in_methods)) known.push_back(std::move(method));
  fail("{} has no {}{}", name, in_quotes(key), did_you_mean(key, known));
}

static int no_such_setter(lua_State* L) {
  const std::string name = lua_tostring(L, lua_upvalueindex(owner));
  if (lua_type(L, 2) != LUA_TSTRING)
    fail("{}: expected a name of a field to set, got a {}", name, luaL_typename(L, 2));
  const std::string key(string_at(L, 2));
  const auto known = string_keys(L, in_methods);  // here: the getters
  for (const auto& getter : known)
    if (getter == key) fail("{}.{} cannot be set: it is read only", name, key);
  fail("{} has no field {} to set{}", name, in_quotes(key), did_you_mean(key, known));
}

// calls the getter that a field's name stands for, if it does
static bool get_field(lua_State* L) {
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(in_fields)) == LUA_TNIL) return false;
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return true;
}

static int member(lua_State* L) {
  lua_settop(L, 2);
  if (lua_type(L, 2) == LUA_TSTRING) {
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(in_methods)) != LUA_TNIL) return 1;
    return get_field(L) ? 1 : guarded<no_such_member>(L);
  }
  if (lua_isnil(L, lua_upvalueindex(in_fallback))) return guarded<no_such_member>(L);
  lua_pushvalue(L, lua_upvalueindex(in_fallback));
  lua_insert(L, 1);
  lua_call(L, 2, 1);
  return 1;
}

// of a library: a computed field, or what the fallback finds
static int library_member(lua_State* L) {
  lua_settop(L, 2);
  if (lua_type(L, 2) != LUA_TSTRING) return 0;
  if (get_field(L)) return 1;
  if (!lua_isnil(L, lua_upvalueindex(in_fallback))) {
    lua_pushvalue(L, lua_upvalueindex(in_fallback));
    lua_pushvalue(L, 2);
    lua_call(L, 1, 1);
    if (!lua_isnil(L, -1)) return 1;
  }
  return guarded<no_such_member>(L);
}

static int set_member(lua_State* L) {
  lua_settop(L, 3);
  lua_pushvalue(L, 2);
  if (lua_type(L, 2) == LUA_TSTRING && lua_rawget(L, lua_upvalueindex(in_fields)) != LUA_TNIL) {
    lua_pushvalue(L, 1);
    lua_pushvalue(L, 3);
    lua_call(L, 2, 0);
    return 0;
  }
  if (lua_type(L, 2) == LUA_TSTRING || lua_isnil(L, lua_upvalueindex(in_fallback)))
    return guarded<no_such_setter>(L);
  lua_pushvalue(L, lua_upvalueindex(in_fallback));
  lua_replace(L, 4);
  lua_insert(L, 1);
  lua_call(L, 3, 0);
  return 0;
}

// the metatable is below; takes the named fallback out of it and puts the lookup in its place
static void set_lookup(lua_State* L, const char* event, lua_CFunction lookup, const char* name,
                       const Class& kind) {
  const bool setting = lookup == set_member;
  lua_newtable(L);
  lua_newtable(L);
  const Class* lineage[8];
  int depth = 0;
  for (const Class* k = &kind; k && depth < 8; k = k->parent) lineage[depth++] = k;
  while (depth--) {
    const Class* k = lineage[depth];
    lua_pushvalue(L, -2);
    set_hidden(L, k->fields, &kind, setting);
    lua_pop(L, 1);
    setting ? set_hidden(L, k->fields, &kind) : set_functions(L, k->methods, &kind);
  }
  lua_getfield(L, -3, event);
  lua_pushstring(L, name);
  lua_pushcclosure(L, lookup, 4);
  lua_setfield(L, -2, event);
}

void push_metatable(lua_State* L, const Class& kind) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &kind) == LUA_TTABLE) return;
  lua_pop(L, 1);
  luaL_checkstack(L, 12, nullptr);
  lua_newtable(L);
  set_hidden(L, kind.operators, &kind);
  set_lookup(L, "__index", member, kind.variable, kind);
  set_lookup(L, "__newindex", set_member, kind.variable, kind);
  lua_pushstring(L, kind.name);
  lua_setfield(L, -2, "__name");
  lua_pushstring(L, kind.name);
  lua_setfield(L, -2, "__metatable");
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &kind);
}

// --- libraries ---

// leaves the table named by "clench.json" below the root, each on the way made if it is missing
static void push_library_table(lua_State* L, int root, const char* name) {
  lua_pushvalue(L, root);
  for (const char* dot = std::strchr(name, '.'); dot; dot = std::strchr(dot + 1, '.')) {
    const char* part = dot + 1;
    const char* end = std::strchr(part, '.');
    lua_pushlstring(L, part, end ? static_cast<size_t>(end - part) : std::strlen(part));
    lua_pushvalue(L, -1);
    if (lua_rawget(L, -3) != LUA_TTABLE) {
      lua_pop(L, 1);
      lua_newtable(L);
      lua_pushvalue(L, -2);
      lua_pushvalue(L, -2);
      lua_rawset(L, -5);
    }
    lua_replace(L, -3);
    lua_pop(L, 1);
  }
}

// below is the library's table: gives it a metatable that knows computed fields and answers
// misspelt names
static void set_library_lookup(lua_State* L, const Library& library) {
  lua_newtable(L);
  lua_newtable(L);
  lua_pushvalue(L, -1);
  lua_setfield(L, -3, "getters");
  lua_pushvalue(L, -3);
  lua_pushnil(L);
  lua_pushstring(L, library.name);
  lua_pushcclosure(L, library_member, 4);
  lua_setfield(L, -2, "__index");
  lua_pushstring(L, library.name);
  lua_setfield(L, -2, "__name");
  lua_setmetatable(L, -2);
}

void open_library(lua_State* L, int root, const Library& library) {
  luaL_checkstack(L, 12, nullptr);
  root = lua_absindex(L, root);
  push_library_table(L, root, library.name);
  set_functions(L, library.functions, nullptr, &library);
  if (!lua_getmetatable(L, -1)) {
    set_library_lookup(L, library);
    lua_getmetatable(L, -1);
  }
  lua_getfield(L, -1, "getters");
  set_hidden(L, library.fields, nullptr, false, &library);
  lua_pop(L, 3);
}

void set_library_fallback(lua_State* L, int library) {
  lua_getmetatable(L, library);
  lua_getfield(L, -1, "__index");
  lua_pushvalue(L, -3);
  lua_setupvalue(L, -2, in_fallback);
  lua_pop(L, 3);
}

}  // namespace clench
