// Functions of the engine that the standard library requires like its own files: clench.raise,
// clench.script_line, clench.suggest, clench.deadline.
#pragma once
#include <lua.hpp>

namespace clench {

void add_natives(lua_State* L);

}  // namespace clench
