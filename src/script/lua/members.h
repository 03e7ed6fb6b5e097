// What the lookups in classes and in libraries share: closures of entries in tables, and names that
// are not there.
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

/// Into the table on top: what a script calls itself, with as many arguments as its doc says.
void set_functions(lua_State* L, std::span<const Entry> entries, const Class* kind,
                   const Library* library = nullptr);
/// Into the table on top: what a lookup or Lua calls, getters, setters or operators.
void set_hidden(lua_State* L, std::span<const Entry> entries, const Class* kind,
                bool setters = false, const Library* library = nullptr);

/// The running lookup's keys in one of its upvalues, sorted.
std::vector<std::string> string_keys(lua_State* L, int upvalue);
/// Calls the getter that the key at 2 stands for with the value at 1; false: it stands for none.
bool get_field(lua_State* L);
/// throws  Error "hand has no 'autogrsp'; did you mean 'autograsp'?"
int no_such_member(lua_State* L);

}  // namespace clench
