#include "script/guard.h"

#include <cstring>

namespace clench {

static const char raised_key = 0;  // its address names the place of the waiting error value

void protected_call(lua_State* L, int arguments, int results) {
  if (lua_pcall(L, arguments, results, 0) == LUA_OK) return;
  lua_rawsetp(L, LUA_REGISTRYINDEX, &raised_key);
  throw Raised();
}

// what an exception said, in memory that needs no destructor
struct Message {
  char text[2000];

  void copy(const char* what) {
    const size_t size = std::strlen(what);
    std::strncpy(text, what, sizeof text - 1);
    text[sizeof text - 1] = 0;
    if (size >= sizeof text) std::strcpy(text + sizeof text - 4, "...");
  }
};

enum class Failure { none, raised, message };

static Failure run_caught(lua_State* L, lua_CFunction fn, int& results, Message& message) {
  try {
    results = fn(L);
    return Failure::none;
  } catch (const Raised&) {
    return Failure::raised;
  } catch (const std::exception& e) {
    message.copy(e.what());
    return Failure::message;
  }
}

int run_guarded(lua_State* L, lua_CFunction fn) {
  int results = 0;
  Message message;
  const Failure failure = run_caught(L, fn, results, message);
  if (failure == Failure::none) return results;

  // the handler is left: nothing but plain memory is alive
  lua_settop(L, 0);
  if (failure == Failure::raised) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &raised_key);
    lua_pushnil(L);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &raised_key);
  } else {
    // a field's getter is called by the lookup, and that by the script
    luaL_where(L, 1);
    if (lua_rawlen(L, -1) == 0) luaL_where(L, 2);
    lua_pushstring(L, message.text);
    lua_concat(L, lua_gettop(L));
  }
  return -1;
}

}  // namespace clench
