// Functions shared by the lookups in classes and in libraries: closures of entries in tables, and
// errors for unknown names.
#pragma once
#include <lua.hpp>
#include <span>
#include <string>
#include <vector>

#include "clench/script/lua/entry.h"

namespace clench {

/// Upvalues of every lookup: tables of getters or setters and of methods or functions, a fallback
/// or nil, the owner's name.
enum Lookup { in_fields = 1, in_methods = 2, in_fallback = 3, owner = 4 };

/// Adds entries that scripts call to the table on top, with as many arguments as their docs
/// describe.
void set_functions(lua_State* L, std::span<const Entry> entries, const Class* kind,
                   const Library* library = nullptr);
/// Adds entries that a lookup or Lua calls to the table on top: getters, setters or operators.
void set_hidden(lua_State* L, std::span<const Entry> entries, const Class* kind,
                bool setters = false, const Library* library = nullptr);

/// Sorted keys of one of the running lookup's upvalues.
std::vector<std::string> string_keys(lua_State* L, int upvalue);
/// Calls the getter for the key at 2 with the value at 1; returns false if there is none.
bool get_field(lua_State* L);
/// throws  Error "hand has no 'autogrsp'; did you mean 'autograsp'?"
int no_such_member(lua_State* L);

}  // namespace clench
