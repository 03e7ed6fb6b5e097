// Lua as text: chunks that are loaded from files and strings, and never a compiled one, which Lua
// runs unchecked.
#pragma once
#include <cstddef>

struct lua_State;

namespace clench {

/// luaL_loadfilex and luaL_loadbufferx for text; of a compiled chunk they say "mine.lua: bytecode
/// is not run; expected Lua text".
/// path  null: stdin
int load_text_file(lua_State* L, const char* path);
int load_text(lua_State* L, const char* text, size_t size, const char* name);

/// Leaves what require wants of a searcher that has found the file of a module.
int load_module(lua_State* L, const char* module, const char* path);

/// Replaces load, loadfile, dofile, and what require uses for files of Lua.
/// throws a Lua error when package.searchers is no longer as Lua makes it
void refuse_bytecode(lua_State* L);

}  // namespace clench
