// Worlds from files and to files, as clench.load and world:save.
#pragma once
#include <lua.hpp>

namespace clench {

/// (path, options) -> world
int load_world(lua_State* L);
/// (world, path, options)
int save_world(lua_State* L);

}  // namespace clench
