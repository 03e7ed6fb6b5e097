#include "clench/script/lua/chunks.h"

#include <cstring>
#include <lua.hpp>

#include "clench/script/lua/copied_table.h"
#include "clench/script/lua/packed.h"

namespace clench {

static void push_refusal(lua_State* L, const char* name) {
  lua_pushfstring(L, "%s: bytecode is not run; expected Lua text", name);
}

// Lua's own messages name neither the file nor the expected content
static int in_our_words(lua_State* L, int status, const char* name) {
  static constexpr char said[] = "attempt to load a binary chunk";
  if (status != LUA_ERRSYNTAX || std::strncmp(lua_tostring(L, -1), said, sizeof said - 1))
    return status;
  lua_pop(L, 1);
  push_refusal(L, name);
  return status;
}

// "@mine.lua" is a file, "=mine" a name; anything else is the text itself
static const char* plain_name(const char* name) {
  return *name == '@' || *name == '=' ? name + 1 : "load";
}

int load_text_file(lua_State* L, const char* path) {
  return in_our_words(L, luaL_loadfilex(L, path, "t"), path ? path : "stdin");
}

int load_text(lua_State* L, const char* text, size_t size, const char* name) {
  keep_chunk_text(L, text, size, name);
  return in_our_words(L, luaL_loadbufferx(L, text, size, name, "t"), plain_name(name));
}

int load_module(lua_State* L, const char* module, const char* path) {
  if (load_text_file(L, path) != LUA_OK)
    return luaL_error(L, "error loading module '%s' from file '%s':\n\t%s", module, path,
                      lua_tostring(L, -1));
  lua_pushstring(L, path);
  return 2;
}

// --- Lua's functions, restricted to text ---

// results of load and loadfile; environment: index of that of the chunk, 0: the globals
static int give_chunk(lua_State* L, int status, int environment) {
  if (status != LUA_OK) {
    lua_pushnil(L);
    lua_insert(L, -2);
    return 2;
  }
  if (environment) {
    lua_pushvalue(L, environment);
    if (!lua_setupvalue(L, -2, 1)) lua_pop(L, 1);
  }
  return 1;
}

// the mode "b" requests compiled chunks, which are rejected
static bool takes_text(const char* mode) { return std::strchr(mode, 't') != nullptr; }

static constexpr int part_slot = 5;  // keeps the reader's last part alive

static const char* read_part(lua_State* L, void*, size_t* size) {
  luaL_checkstack(L, 2, "too many nested functions");
  lua_pushvalue(L, 1);
  lua_call(L, 0, 1);
  if (lua_isnil(L, -1)) {
    lua_pop(L, 1);
    *size = 0;
    return nullptr;
  }
  if (!lua_isstring(L, -1)) luaL_error(L, "reader function must return a string");
  lua_replace(L, part_slot);
  return lua_tolstring(L, part_slot, size);
}

static int load_chunk(lua_State* L) {
  size_t size = 0;
  const char* text = lua_tolstring(L, 1, &size);
  const char* name = luaL_optstring(L, 2, text ? text : "=(load)");
  const char* mode = luaL_optstring(L, 3, "bt");
  const int environment = lua_isnone(L, 4) ? 0 : 4;
  if (!text) luaL_checktype(L, 1, LUA_TFUNCTION);
  if (!takes_text(mode)) {
    push_refusal(L, plain_name(name));
    return give_chunk(L, LUA_ERRSYNTAX, 0);
  }
  if (text) return give_chunk(L, load_text(L, text, size, name), environment);
  lua_settop(L, part_slot);
  const int status = lua_load(L, read_part, nullptr, name, "t");
  return give_chunk(L, in_our_words(L, status, plain_name(name)), environment);
}

static int load_file(lua_State* L) {
  const char* path = luaL_optstring(L, 1, nullptr);
  const char* mode = luaL_optstring(L, 2, "bt");
  const int environment = lua_isnone(L, 3) ? 0 : 3;
  if (!takes_text(mode)) {
    push_refusal(L, path ? path : "stdin");
    return give_chunk(L, LUA_ERRSYNTAX, 0);
  }
  return give_chunk(L, load_text_file(L, path), environment);
}

static int give_all(lua_State* L, int, lua_KContext) { return lua_gettop(L) - 1; }

static int do_file(lua_State* L) {
  const char* path = luaL_optstring(L, 1, nullptr);
  lua_settop(L, 1);
  if (load_text_file(L, path) != LUA_OK) return lua_error(L);
  lua_callk(L, 0, LUA_MULTRET, 0, give_all);
  return give_all(L, 0, 0);
}

// upvalues: package, its searchpath
static int search_path(lua_State* L) {
  const char* module = luaL_checkstring(L, 1);
  lua_settop(L, 1);
  lua_pushvalue(L, lua_upvalueindex(2));
  lua_pushvalue(L, 1);
  if (lua_getfield(L, lua_upvalueindex(1), "path") != LUA_TSTRING)
    return luaL_error(L, "'package.path' must be a string");
  lua_call(L, 2, 2);
  if (lua_isnil(L, -2)) return 1;  // second result: the searched path
  return load_module(L, module, lua_tostring(L, -2));
}

static void replace_searcher(lua_State* L) {
  if (lua_getglobal(L, LUA_LOADLIBNAME) == LUA_TTABLE) {
    const int package = lua_gettop(L);
    lua_getfield(L, package, "searchers");
    // our searchers may already precede them
    const int first = lua_istable(L, -1) ? count_packed_searchers(L, package + 1) + 1 : 0;
    if (!first || lua_rawlen(L, package + 1) != static_cast<size_t>(first) + 3)
      luaL_error(L, "clench_refuse_bytecode: expected package.searchers as Lua makes them");
    lua_pushvalue(L, package);
    lua_getfield(L, package, "searchpath");
    lua_pushcclosure(L, search_path, 2);
    lua_rawseti(L, package + 1, first + 1);  // after that of package.preload
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
}

void refuse_bytecode(lua_State* L) {
  lua_register(L, "load", load_chunk);
  lua_register(L, "loadfile", load_file);
  lua_register(L, "dofile", do_file);
  replace_searcher(L);
}

}  // namespace clench
