// How Lua finds what entries give: metatables of classes, tables of libraries.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

/// Leaves the metatable of a class on the stack, made at the first call.
void push_metatable(lua_State* L, const Class& kind);

/// Adds the entries to the table below `root` that the library's name says, made if need be.
void open_library(lua_State* L, int root, const Library& library);

/// Pops a function(name) that is asked for members that the library at the index lacks;
/// nil: not known either.
void set_library_fallback(lua_State* L, int library);

}  // namespace clench
