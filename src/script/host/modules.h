// A user's own modules: require searches the folder of the running script, and then LUA_PATH and
// LUA_CPATH; never the current folder.
#pragma once

struct lua_State;

namespace clench {

/// Makes require search there, for a state whose LUA_NOENV was set before its libraries were
/// opened. Setting::modules names the script's folder.
void add_user_modules(lua_State* L);

}  // namespace clench
