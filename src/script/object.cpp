#include "script/object.h"

#include "base/error.h"
#include "script/check.h"

namespace clench {

bool has_class(lua_State* L, int index, const Class& kind) {
  if (lua_type(L, index) != LUA_TUSERDATA || !lua_getmetatable(L, index)) return false;
  lua_rawgetp(L, LUA_REGISTRYINDEX, &kind);
  const bool same = lua_rawequal(L, -1, -2);
  lua_pop(L, 2);
  return same;
}

// --- memory that Lua does not see ---

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

void fail_self(lua_State* L, const Class& kind) {
  const std::string name = subject(L);
  const bool closed = has_class(L, 1, kind);
  if (closed) fail("{}: the {} was closed", name, kind.name);
  const bool method = name.find(':') != std::string::npos;
  fail("{}: expected {}{}, got {}{}", name, with_article(kind.name),
       method ? " before the colon" : "", described(L, 1), method ? "; use " + name + "(...)" : "");
}

void fail_object(const What& what, const Class& kind, int index) {
  const std::string expected = with_article(kind.name);
  if (has_class(what.L, index, kind))
    fail("{}: expected {}, got one that was closed", what.text(), expected);
  fail_expected(what, expected, index);
}

void check_count(lua_State* L, int most) {
  const int self = running_class(L) ? 1 : 0;
  const int count = lua_gettop(L) - self;
  if (count > most)
    fail("{}: expected at most {} argument{}, got {}", subject(L), most, most == 1 ? "" : "s",
         count);
}

}  // namespace clench
