#include "clench/script/host/open.h"

#include <lua.hpp>

#include "clench/script/host/library_list.h"
#include "clench/script/host/library_table.h"
#include "clench/script/host/natives.h"
#include "clench/script/lua/chunks.h"
#include "clench/script/lua/described_options.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/lookup.h"
#include "clench/script/lua/packed.h"

namespace clench {

// clench.shapes: the standard library's module, loaded on first use
static int load_member(lua_State* L) {
  const char* name = lua_tostring(L, 1);
  if (!find_packed(name)) return 0;
  push_packed(L, name);
  return 1;
}

}  // namespace clench

int clench_open(lua_State* L) {
  using namespace clench;
  luaL_checkversion(L);
  push_root(L, "clench");
  const int module = lua_gettop(L);
  for (const Library* library : all_libraries()) open_library(L, module, *library);
  for (const Class* kind : all_classes()) {
    push_metatable(L, *kind);
    lua_pop(L, 1);
  }
  lua_pushcfunction(L, load_member);
  set_library_fallback(L, module);
  add_packed_searcher(L, module);
  push_packed(L, "error_value");
  set_error_metatable(L);
  set_described_entries(L, all_libraries(), all_classes());
  add_natives(L);
  return 1;
}

int clench_refuse_bytecode(lua_State* L) {
  clench::refuse_bytecode(L);
  return 0;
}
