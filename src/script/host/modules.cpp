#include "clench/script/host/modules.h"

#include <cstdio>
#include <lua.hpp>

#include "clench/script/lua/chunks.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/setting.h"

namespace clench {

static bool is_readable(const char* path) {
  std::FILE* file = std::fopen(path, "r");
  if (file) std::fclose(file);
  return file != nullptr;
}

static int search_beside(lua_State* L) {
  const char* module = luaL_checkstring(L, 1);
  push_setting(L, Setting::modules);
  const char* folder = lua_tostring(L, -1);
  if (!*folder) return 0;
  const char* name = luaL_gsub(L, module, ".", LUA_DIRSEP);
  lua_pushfstring(L, "%s" LUA_DIRSEP "%s.lua", folder, name);
  lua_pushfstring(L, "%s" LUA_DIRSEP "%s" LUA_DIRSEP "init.lua", folder, name);
  for (const int path : {-2, -1})
    if (is_readable(lua_tostring(L, path))) return load_module(L, module, lua_tostring(L, path));
  lua_pushfstring(L, "no file '%s'\n\tno file '%s'", lua_tostring(L, -2), lua_tostring(L, -1));
  return 1;
}

void add_user_modules(lua_State* L) {
  push_packed(L, "host.paths");
  lua_call(L, 0, 0);
  lua_pushcfunction(L, search_beside);
  insert_searcher(L, 2);  // after that of package.preload
}

}  // namespace clench
