// Embeds Clench in the Lua of a host program, which needs only this header.
#pragma once

struct lua_State;

/// Pushes the module's table, like a Lua loader; make it available to scripts by
///     luaL_requiref(L, "clench", clench_open, 1);
/// The state's standard libraries should be open. Lua 5.4, built as C or as C++, from the host's
/// own library.
extern "C" int clench_open(lua_State* L);

/// From now on load, loadfile, dofile and require accept only Lua text, because a compiled chunk
/// can crash its state. Call it as a Lua function, right after luaL_openlibs:
///     lua_pushcfunction(L, clench_refuse_bytecode);
///     lua_call(L, 0, 0);
extern "C" int clench_refuse_bytecode(lua_State* L);
