#include "clench/script/host/library_table.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/members.h"
#include "clench/script/lua/stack.h"

namespace clench {

// value of a library's name: a computed field, or the result of the fallback
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

// the arguments named by a function's doc, as in a call
static std::string argument_names(const Entry& entry) {
  constexpr std::string_view mark = "\n@param ";
  const std::string_view doc = entry.doc;
  std::string names;
  for (size_t at = doc.find(mark); at != doc.npos; at = doc.find(mark, at + 1)) {
    const std::string_view rest = doc.substr(at + mark.size());
    if (!names.empty()) names += ", ";
    names += rest.substr(0, rest.find_first_of("? \n"));
  }
  return names;
}

static int refuse_assignment(lua_State* L) {
  const std::string name = lua_tostring(L, lua_upvalueindex(owner));
  if (lua_type(L, 2) != LUA_TSTRING)
    fail("{}: expected a name to set, got a {}", name, luaL_typename(L, 2));
  const std::string key(string_at(L, 2));
  auto known = string_keys(L, in_fields);
  for (auto& function : string_keys(L, in_methods)) known.push_back(std::move(function));
  lua_pushvalue(L, 2);
  lua_rawget(L, lua_upvalueindex(in_methods));
  if (lua_iscfunction(L, -1) && lua_getupvalue(L, -1, at_entry)) {
    const auto& entry = *static_cast<const Entry*>(lua_touserdata(L, -1));
    fail("{}.{} cannot be set: it is a function; call {}.{}({})", name, key, name, key,
         argument_names(entry));
  }
  if (lua_toboolean(L, 4) || std::find(known.begin(), known.end(), key) != known.end())
    fail("{}.{} cannot be set: it is read only", name, key);
  fail("{} has no {} to set{}; a script keeps its values in its own variables", name,
       in_quotes(key), did_you_mean(key, known));
}

static int set_library_member(lua_State* L) {
  lua_settop(L, 2);
  lua_pushnil(L);
  lua_pushboolean(L, 0);  // 4: does the fallback know it?
  if (lua_type(L, 2) == LUA_TSTRING && !lua_isnil(L, lua_upvalueindex(in_fallback))) {
    lua_pushvalue(L, lua_upvalueindex(in_fallback));
    lua_pushvalue(L, 2);
    lua_call(L, 1, 1);
    lua_pushboolean(L, !lua_isnil(L, -1));
    lua_replace(L, 4);
    lua_settop(L, 4);
  }
  return guarded<refuse_assignment>(L);
}

static int next_library_member(lua_State* L) {
  lua_settop(L, 2);
  if (lua_next(L, 1)) return 2;
  lua_pushnil(L);
  return 1;
}

// pairs(clench.log): upvalue: the functions
static int library_pairs(lua_State* L) {
  lua_pushcfunction(L, next_library_member);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_pushnil(L);
  return 3;
}

// expects the name's table of functions below, and getters on top, which both stay; pushes the
// closure
static void push_library_lookup(lua_State* L, lua_CFunction lookup, const char* name) {
  lua_pushvalue(L, -1);
  lua_pushvalue(L, -3);
  lua_pushnil(L);
  lua_pushstring(L, name);
  lua_pushcclosure(L, lookup, 4);
}

// pushes a library's table, which is empty except for the errors for misspelt names and assignments
static void push_empty_library(lua_State* L, const char* name) {
  lua_newtable(L);  // the library
  lua_newtable(L);  // its metatable
  lua_pushstring(L, name);
  lua_setfield(L, -2, "__name");
  lua_newtable(L);  // functions
  lua_newtable(L);  // getters
  lua_pushvalue(L, -1);
  lua_setfield(L, -4, "getters");
  push_library_lookup(L, set_library_member, name);
  lua_setfield(L, -4, "__newindex");
  lua_newtable(L);  // the functions' metatable
  lua_insert(L, -2);
  lua_pushvalue(L, -3);
  lua_insert(L, -2);  // library, metatable, functions, functions' metatable, functions, getters
  push_library_lookup(L, library_member, name);
  lua_setfield(L, -4, "__index");
  lua_pop(L, 2);
  lua_setmetatable(L, -2);
  lua_pushvalue(L, -1);
  lua_pushcclosure(L, library_pairs, 1);
  lua_setfield(L, -3, "__pairs");
  lua_setfield(L, -2, "__index");
  lua_setmetatable(L, -2);
}

// pushes the functions of the library at the index
static void push_functions_of(lua_State* L, int library) {
  lua_getmetatable(L, library);
  lua_getfield(L, -1, "__index");
  lua_remove(L, -2);
}

// pushes the table named by "clench.json" below the root; missing tables on the path are created
static void push_library_table(lua_State* L, int root, const char* name) {
  lua_pushvalue(L, root);
  for (const char* dot = std::strchr(name, '.'); dot; dot = std::strchr(dot + 1, '.')) {
    const char* part = dot + 1;
    const char* end = std::strchr(part, '.');
    const std::string_view key = end ? std::string_view(part, end) : std::string_view(part);
    const std::string_view path(name, key.data() + key.size());
    push_functions_of(L, -1);
    lua_pushlstring(L, key.data(), key.size());
    lua_pushvalue(L, -1);
    if (lua_rawget(L, -3) != LUA_TTABLE) {
      lua_pop(L, 1);
      push_empty_library(L, std::string(path).c_str());
      lua_pushvalue(L, -2);
      lua_pushvalue(L, -2);
      lua_rawset(L, -5);
    }
    lua_replace(L, -4);
    lua_pop(L, 2);
  }
}

void push_root(lua_State* L, const char* name) {
  luaL_checkstack(L, 12, nullptr);
  push_empty_library(L, name);
}

void open_library(lua_State* L, int root, const Library& library) {
  luaL_checkstack(L, 16, nullptr);
  root = lua_absindex(L, root);
  push_library_table(L, root, library.name);
  push_functions_of(L, -1);
  set_functions(L, library.functions, nullptr, &library);
  lua_getmetatable(L, -2);
  lua_getfield(L, -1, "getters");
  set_hidden(L, library.fields, nullptr, false, &library);
  lua_pop(L, 4);
}

void set_library_fallback(lua_State* L, int library) {
  const int fallback = lua_gettop(L);
  lua_getmetatable(L, library);
  lua_getfield(L, -1, "__newindex");
  push_functions_of(L, library);
  lua_getmetatable(L, -1);
  lua_getfield(L, -1, "__index");
  for (const int closure : {fallback + 2, lua_gettop(L)}) {
    lua_pushvalue(L, fallback);
    lua_setupvalue(L, closure, in_fallback);
  }
  lua_settop(L, fallback - 1);
}

}  // namespace clench
