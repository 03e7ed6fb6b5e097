#include "clench/script/lua/members.h"

#include <algorithm>

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

void set_functions(lua_State* L, std::span<const Entry> entries, const Class* kind,
                   const Library* library) {
  for (const Entry& entry : entries) {
    push_closure(L, entry.function, entry, max_arguments(entry), kind, library);
    lua_setfield(L, -2, entry.name);
  }
}

void set_hidden(lua_State* L, std::span<const Entry> entries, const Class* kind, bool setters,
                const Library* library) {
  for (const Entry& entry : entries) {
    const lua_CFunction function = setters ? entry.setter : entry.function;
    if (!function) continue;
    push_closure(L, function, entry, -1, kind, library);
    lua_setfield(L, -2, entry.name);
  }
}

std::vector<std::string> string_keys(lua_State* L, int upvalue) {
  std::vector<std::string> keys;
  if (!lua_istable(L, lua_upvalueindex(upvalue))) return keys;
  for (lua_pushnil(L); lua_next(L, lua_upvalueindex(upvalue)); lua_pop(L, 1))
    if (lua_type(L, -2) == LUA_TSTRING) keys.emplace_back(string_at(L, -2));
  std::sort(keys.begin(), keys.end());
  return keys;
}

int no_such_member(lua_State* L) {
  const std::string name = lua_tostring(L, lua_upvalueindex(owner));
  if (lua_type(L, 2) != LUA_TSTRING)
    fail("{}: expected a name of a field or method, got a {}", name, luaL_typename(L, 2));
  const std::string key(string_at(L, 2));
  auto known = string_keys(L, in_fields);
  for (auto& method : string_keys(L, in_methods)) known.push_back(std::move(method));
  fail("{} has no {}{}", name, in_quotes(key), did_you_mean(key, known));
}

bool get_field(lua_State* L) {
  lua_pushvalue(L, 2);
  if (lua_rawget(L, lua_upvalueindex(in_fields)) == LUA_TNIL) return false;
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return true;
}

}  // namespace clench
