// How Lua finds what entries of a class give: its metatable.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

/// Leaves the metatable of a class on the stack, made at the first call.
void push_metatable(lua_State* L, const Class& kind);

}  // namespace clench
