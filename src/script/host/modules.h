// A user's own modules: require looks for them beside the script that runs, and then where LUA_PATH
// and LUA_CPATH say; never in the folder that one happens to be in.
#pragma once

struct lua_State;

namespace clench {

/// Makes require look so, for a state whose LUA_NOENV was set before its libraries were opened.
/// Setting::modules names the script's folder.
void add_user_modules(lua_State* L);

}  // namespace clench
