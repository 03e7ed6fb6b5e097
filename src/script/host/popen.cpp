#include "clench/script/host/popen.h"

#include <stdio_ext.h>

#include <string_view>

namespace clench {

// popen(command, mode); upvalue: Lua's own
static int popen_unlocked(lua_State* L) {
  luaL_checkstring(L, 1);
  const std::string_view mode = luaL_optstring(L, 2, "r");
  luaL_argcheck(L, mode == "r" || mode == "w", 2, "invalid mode");
  lua_settop(L, 2);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_insert(L, 1);
  lua_call(L, 2, LUA_MULTRET);
  // one state, and so one thread, reads it
  const auto* file = static_cast<luaL_Stream*>(luaL_testudata(L, 1, LUA_FILEHANDLE));
  if (file && mode == "r") __fsetlocking(file->f, FSETLOCKING_BYCALLER);
  return lua_gettop(L);
}

void replace_popen(lua_State* L) {
  lua_getglobal(L, LUA_IOLIBNAME);
  lua_getfield(L, -1, "popen");
  lua_pushcclosure(L, popen_unlocked, 1);
  lua_setfield(L, -2, "popen");
  lua_pop(L, 1);
}

}  // namespace clench
