// Clench in somebody else's Lua: the one header that a host needs.
#pragma once

struct lua_State;

/// Leaves the module's table on the stack, as a Lua loader does; put it where scripts look:
///     luaL_requiref(L, "clench", clench_open, 1);
/// The state's standard libraries should be open. Lua 5.4, built as C or as C++, from the host's
/// own library.
extern "C" int clench_open(lua_State* L);
