#include "clench/script/lua/owned.h"

#include <algorithm>
#include <new>

namespace clench {

namespace {

constexpr int64_t min_growth = 64 << 10;  // [KB]

// of a state, in KB
struct OwnedMemory {
  int64_t now = 0, limit = min_growth;
};

const char owned_key = 0;  // its address names the state's

OwnedMemory& owned_memory(lua_State* L) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &owned_key) != LUA_TUSERDATA) {
    lua_pop(L, 1);
    new (lua_newuserdatauv(L, sizeof(OwnedMemory), 0)) OwnedMemory;
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &owned_key);
  }
  auto& memory = *static_cast<OwnedMemory*>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  return memory;
}

}  // namespace

void count_owned(lua_State* L, int64_t kilobytes) { owned_memory(L).now += kilobytes; }

void collect_owned(lua_State* L) {
  OwnedMemory& memory = owned_memory(L);
  // a collector that is stopped, or that runs this very code, is left alone
  if (memory.now < memory.limit || lua_gc(L, LUA_GCISRUNNING) != 1) return;
  lua_gc(L, LUA_GCCOLLECT);
  // a collection takes as long as Lua's own memory is large
  const int64_t growth = std::max<int64_t>(min_growth, 2 * lua_gc(L, LUA_GCCOUNT));
  memory.limit = memory.now + growth;
}

}  // namespace clench
