// Objects stored in the registry of a Lua state until it closes.
#pragma once
#include <lua.hpp>
#include <new>
#include <type_traits>

namespace clench {

/// Pushes the table whose registry key is the address of `key`, created on first use.
/// returns  true if it is new
inline bool push_kept_table(lua_State* L, const void* key) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, key) == LUA_TTABLE) return false;
  lua_pop(L, 1);
  lua_newtable(L);
  lua_pushvalue(L, -1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, key);
  return true;
}

/// The only T of the state, created on first use.
template <class T>
T& kept(lua_State* L) {
  static_assert(alignof(T) <= 8, "Lua aligns to 8 bytes only");
  static const char key = 0;  // its address is the registry key of the T
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &key) != LUA_TUSERDATA) {
    lua_pop(L, 1);
    new (lua_newuserdatauv(L, sizeof(T), 0)) T();
    if constexpr (!std::is_trivially_destructible_v<T>) {
      lua_createtable(L, 0, 1);
      lua_pushcfunction(L, [](lua_State* state) {
        static_cast<T*>(lua_touserdata(state, 1))->~T();
        return 0;
      });
      lua_setfield(L, -2, "__gc");
      lua_setmetatable(L, -2);
    }
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &key);
  }
  T& value = *static_cast<T*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return value;
}

}  // namespace clench
