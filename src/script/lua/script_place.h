// Where a script called into Clench.
#pragma once
#include <lua.hpp>

namespace clench {

/// Pushes "a.lua:3: ", of the innermost function that is neither C nor of the standard library; ""
/// where there is none. No C++ object may be alive where Lua errors jump: it raises them for want
/// of memory.
void push_script_place(lua_State* L);

}  // namespace clench
