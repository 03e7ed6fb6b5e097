// require "clench" from any Lua 5.4: the only source file of the loadable module.
#include "clench/script/host/open.h"

extern "C" __attribute__((visibility("default"))) int luaopen_clench(lua_State* L) {
  return clench_open(L);
}
