// Lists of bodies and robots, which scripts read by numbers: a name is an error that says how one
// is found.
#pragma once
#include "clench/script/lua/entry.h"

namespace clench {

/// Makes the list on top of the stack, the value of the running field, answer to names:
/// "world.robots has no 'hand': it is a list; did you mean world:robot("hand")?". Its length,
/// ipairs, pairs and numbers beyond its end are as ever.
/// finder  the method that finds one of its items by name, "world:robot"
/// kind    what the items are
/// returns 1
int set_finder(lua_State* L, const char* finder, const Class& kind);

}  // namespace clench
