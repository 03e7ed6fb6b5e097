// Loads Lua text from files and strings; compiled chunks, which Lua runs unchecked, are rejected.
#pragma once
#include <cstddef>

struct lua_State;

namespace clench {

/// luaL_loadfilex and luaL_loadbufferx for text; for a compiled chunk they return "mine.lua:
/// bytecode is not run; expected Lua text".
/// path  null: stdin
int load_text_file(lua_State* L, const char* path);
int load_text(lua_State* L, const char* text, size_t size, const char* name);

/// Pushes the results of a searcher of require that has found the file of a module.
int load_module(lua_State* L, const char* module, const char* path);

/// Replaces load, loadfile, dofile, and the searcher of require for Lua files.
/// throws  a Lua error if package.searchers is not in its original form
void refuse_bytecode(lua_State* L);

}  // namespace clench
