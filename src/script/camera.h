// The camera that a world's file gives, as scripts see it.
#pragma once
#include <lua.hpp>

namespace clench {

int get_camera(lua_State* L);
int set_camera(lua_State* L);

}  // namespace clench
