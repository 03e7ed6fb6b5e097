#include "clench/script/lua/owned.h"

#include <algorithm>

#include "clench/script/lua/kept.h"

namespace clench {

namespace {

constexpr int64_t min_growth = 64 << 10;  // [KB]

// memory of a state [KB]
struct OwnedMemory {
  int64_t now = 0, limit = min_growth;
};

}  // namespace

void count_owned(lua_State* L, int64_t kilobytes) { kept<OwnedMemory>(L).now += kilobytes; }

void collect_owned(lua_State* L) {
  auto& memory = kept<OwnedMemory>(L);
  // a stopped collector, or one that runs this code, is not called
  if (memory.now < memory.limit || lua_gc(L, LUA_GCISRUNNING) != 1) return;
  lua_gc(L, LUA_GCCOLLECT);
  // the duration of a collection is proportional to Lua's own memory
  const int64_t growth = std::max<int64_t>(min_growth, 2 * lua_gc(L, LUA_GCCOUNT));
  memory.limit = memory.now + growth;
}

}  // namespace clench
