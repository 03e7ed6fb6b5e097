// A grasp as a scene of MuJoCo.
#pragma once
#include <lua.hpp>

namespace clench {

/// (grasp, path, options): as grasp:save
int save_grasp(lua_State* L);

}  // namespace clench
