// Lists of bodies and robots, which scripts index by numbers: a name gives an error that explains
// how to find an item by name.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

/// Makes the list on top of the stack, the value of the running field, respond to names:
/// "world.robots has no 'hand': it is a list; did you mean world:robot("hand")?". Its length,
/// ipairs, pairs and numbers beyond its end are unaffected.
/// finder   the method that finds one of its items by name, "world:robot"
/// kind     kind of the items
/// returns  1
int set_finder(lua_State* L, const char* finder, const Class& kind);

}  // namespace clench
