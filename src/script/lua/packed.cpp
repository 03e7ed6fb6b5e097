#include "clench/script/lua/packed.h"

#include <cstring>
#include <string>

namespace clench {

static bool is_file_of(std::string_view path, std::string_view module) {
  if (!path.ends_with(".lua")) return false;
  path.remove_suffix(4);
  if (path.ends_with("/init") && path.size() - 5 == module.size()) path.remove_suffix(5);
  if (path.size() != module.size()) return false;
  for (size_t i = 0; i < path.size(); ++i)
    if (module[i] == '/' || path[i] != (module[i] == '.' ? '/' : module[i])) return false;
  return true;
}

const PackedFile* find_packed(std::string_view module) {
  for (const PackedFile& file : packed_files())
    if (is_file_of(file.path, module)) return &file;
  return nullptr;
}

// pushes the compiled chunk
static void load_packed(lua_State* L, const PackedFile& file) {
  lua_pushstring(L, "@stdlib/");
  lua_pushlstring(L, file.path.data(), file.path.size());
  lua_concat(L, 2);
  if (luaL_loadbufferx(L, file.text.data(), file.text.size(), lua_tostring(L, -1), "t") != LUA_OK)
    lua_error(L);
  lua_remove(L, -2);
}

void push_packed(lua_State* L, const char* module) {
  luaL_checkstack(L, 8, nullptr);
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  lua_pushfstring(L, "clench.%s", module);
  lua_pushvalue(L, -1);
  if (lua_rawget(L, -3) == LUA_TNIL) {
    lua_pop(L, 1);
    const PackedFile* file = find_packed(module);
    if (!file) luaL_error(L, "clench: no module '%s' in its standard library", module);
    load_packed(L, *file);
    lua_pushvalue(L, -2);
    lua_call(L, 1, 1);
    // a module that returns nothing has the value true, as with require
    if (lua_isnil(L, -1)) {
      lua_pop(L, 1);
      lua_pushboolean(L, 1);
    }
    lua_pushvalue(L, -2);
    lua_pushvalue(L, -2);
    lua_rawset(L, -5);
  }
  lua_replace(L, -3);
  lua_pop(L, 1);
}

void take_packed_function(lua_State* L, const char* module) {
  push_packed(L, module);
  lua_pushvalue(L, 1);
  lua_rawget(L, -2);
  lua_replace(L, 1);
  lua_pop(L, 1);
}

// loader called by require with the name
static int run_packed(lua_State* L) {
  const char* name = luaL_checkstring(L, 1);
  if (!std::strncmp(name, "clench.", 7)) name += 7;
  push_packed(L, name);
  return 1;
}

// pushes the values that require expects of a searcher
static int give_packed(lua_State* L, const PackedFile& file) {
  lua_pushcfunction(L, run_packed);
  lua_pushlstring(L, file.path.data(), file.path.size());
  return 2;
}

static int give_module(lua_State* L) {
  lua_pushvalue(L, lua_upvalueindex(1));
  return 1;
}

// our prefix is reserved: an unknown name is an error, which ends the search
static int search_packed(lua_State* L) {
  const char* name = luaL_checkstring(L, 1);
  if (!std::strcmp(name, "clench")) {
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_pushcclosure(L, give_module, 1);
    lua_pushliteral(L, "clench");
    return 2;
  }
  if (std::strncmp(name, "clench.", 7)) return 0;
  if (const PackedFile* file = find_packed(name + 7)) return give_packed(L, *file);
  return luaL_error(L, "no module '%s' in clench's standard library", name);
}

// modules for scripts; other names are left to the user's own modules
static bool has_bare_name(std::string_view module) {
  for (const std::string_view name : {"report", "shapes", "show", "study", "test"})
    if (module == name || (module.starts_with(name) && module[name.size()] == '.')) return true;
  return false;
}

static int search_bare_name(lua_State* L) {
  const char* name = luaL_checkstring(L, 1);
  if (!has_bare_name(name)) return 0;
  if (const PackedFile* file = find_packed(name)) return give_packed(L, *file);
  return luaL_error(L, "no module '%s' in clench's standard library", name);
}

void insert_searcher(lua_State* L, int place) {
  const int searcher = lua_gettop(L);
  if (lua_getglobal(L, LUA_LOADLIBNAME) == LUA_TTABLE &&
      lua_getfield(L, -1, "searchers") == LUA_TTABLE) {
    for (auto i = static_cast<lua_Integer>(lua_rawlen(L, -1)); i >= place; --i) {
      lua_rawgeti(L, -1, i);
      lua_rawseti(L, -2, i + 1);
    }
    lua_pushvalue(L, searcher);
    lua_rawseti(L, -2, place);
  }
  lua_settop(L, searcher - 1);
}

void add_packed_searcher(lua_State* L, int module) {
  lua_pushvalue(L, module);
  lua_pushcclosure(L, search_packed, 1);
  insert_searcher(L, 1);
}

void add_bare_names(lua_State* L) {
  lua_pushcfunction(L, search_bare_name);
  insert_searcher(L, 1);
}

int count_packed_searchers(lua_State* L, int searchers) {
  int count = 0;
  for (bool ours = true; ours; count += ours) {
    lua_rawgeti(L, searchers, count + 1);
    const lua_CFunction searcher = lua_tocfunction(L, -1);
    ours = searcher == search_packed || searcher == search_bare_name;
    lua_pop(L, 1);
  }
  return count;
}

}  // namespace clench
