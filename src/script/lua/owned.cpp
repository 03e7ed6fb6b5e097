#include "clench/script/lua/owned.h"

#include <algorithm>

#include "clench/script/lua/kept.h"

namespace clench {

namespace {

constexpr int64_t min_growth = 64 << 10;  // [KB]

// of a state, in KB
struct OwnedMemory {
  int64_t now = 0, limit = min_growth;
};

}  // namespace

void count_owned(lua_State* L, int64_t kilobytes) { kept<OwnedMemory>(L).now += kilobytes; }

void collect_owned(lua_State* L) {
  auto& memory = kept<OwnedMemory>(L);
  // a collector that is stopped, or that runs this very code, is left alone
  if (memory.now < memory.limit || lua_gc(L, LUA_GCISRUNNING) != 1) return;
  lua_gc(L, LUA_GCCOLLECT);
  // a collection takes as long as Lua's own memory is large
  const int64_t growth = std::max<int64_t>(min_growth, 2 * lua_gc(L, LUA_GCCOUNT));
  memory.limit = memory.now + growth;
}

}  // namespace clench
