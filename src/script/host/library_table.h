// Lookup of the entries of a library in Lua: an empty table that reads from a table of functions
// and from sublibraries, so that every assignment can be rejected.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

/// Pushes an empty library, below which others are opened. All are read only: an assignment to one
/// of their names gives an error that explains how the name is used.
void push_root(lua_State* L, const char* name);

/// Adds the entries to the table below `root` that has the library's name, created if necessary.
void open_library(lua_State* L, int root, const Library& library);

/// Pops a function(name) that is called for members that the library at the index lacks; nil: not
/// known either.
void set_library_fallback(lua_State* L, int library);

}  // namespace clench
