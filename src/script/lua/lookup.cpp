#include "clench/script/lua/lookup.h"

#include <algorithm>
#include <string>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/script/lua/copied_table.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/members.h"
#include "clench/script/lua/stack.h"

namespace clench {

static int no_such_setter(lua_State* L) {
  const std::string name = lua_tostring(L, lua_upvalueindex(owner));
  if (lua_type(L, 2) != LUA_TSTRING)
    fail("{}: expected a name of a field to set, got a {}; its items are only read", name,
         luaL_typename(L, 2));
  const std::string key(string_at(L, 2));
  const auto known = string_keys(L, in_methods);  // here: the getters
  for (const auto& getter : known)
    if (getter == key) fail("{}.{} cannot be set: it is read only", name, key);
  fail("{} has no field {} to set{}", name, in_quotes(key), did_you_mean(key, known));
}

// expects the value of a field, a table, on top
static int copied(lua_State* L) {
  check_part_not_assigned(L, lua_tostring(L, lua_upvalueindex(owner)), lua_tostring(L, 2));
  return 1;
}

static int member(lua_State* L) {
  lua_settop(L, 2);
  if (lua_type(L, 2) == LUA_TSTRING) {
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(in_methods)) != LUA_TNIL) return 1;
    if (!get_field(L)) return guarded<no_such_member>(L);
    return lua_istable(L, -1) ? guarded<copied>(L) : 1;
  }
  if (lua_isnil(L, lua_upvalueindex(in_fallback))) return guarded<no_such_member>(L);
  lua_pushvalue(L, lua_upvalueindex(in_fallback));
  lua_insert(L, 1);
  lua_call(L, 2, 1);
  return 1;
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

// replaces the named fallback of the metatable below by the lookup
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

}  // namespace clench
