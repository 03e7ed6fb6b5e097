// How Lua finds what entries of a library give: an empty table that reads from one of functions and
// of libraries below it, so that every assignment can be refused.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

/// Leaves an empty library on the stack, below which others are opened. It and they are read only:
/// an assignment to a name of theirs is an error that says how the name is used.
void push_root(lua_State* L, const char* name);

/// Adds the entries to the table below `root` that the library's name says, made if need be.
void open_library(lua_State* L, int root, const Library& library);

/// Pops a function(name) that is asked for members that the library at the index lacks;
/// nil: not known either.
void set_library_fallback(lua_State* L, int library);

}  // namespace clench
