// Lookup of the entries of a class in Lua: its metatable.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

/// Pushes the metatable of a class, created at the first call.
void push_metatable(lua_State* L, const Class& kind);

}  // namespace clench
