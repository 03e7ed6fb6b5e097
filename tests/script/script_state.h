// A Lua state with clench in it, for tests.
#pragma once
#include <doctest/doctest.h>

#include <lua.hpp>
#include <string>

#include "clench/script/host/open.h"

namespace clench::test {

class Script {
 public:
  Script() : L(luaL_newstate()) {
    luaL_openlibs(L);
    luaL_requiref(L, "clench", clench_open, 1);
    lua_pop(L, 1);
  }
  ~Script() { lua_close(L); }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// output of an expression, or the message of its error
  std::string text(const std::string& expression) { return run("return " + expression); }

  /// values returned by a chunk, printed, or the message of its error
  std::string run(const std::string& chunk) {
    lua_settop(L, 0);
    if (luaL_loadbufferx(L, chunk.data(), chunk.size(), "=test", "t") == LUA_OK)
      lua_pcall(L, 0, LUA_MULTRET, 0);
    std::string out;
    for (int i = 1; i <= lua_gettop(L); ++i) {
      out += (i > 1 ? ", " : "") + std::string(luaL_tolstring(L, i, nullptr));
      lua_pop(L, 1);
    }
    CHECK(lua_gettop(L) >= 0);
    return out;
  }

  lua_State* L;
};

}  // namespace clench::test
