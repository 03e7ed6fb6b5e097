// A limit on the memory of Lua values created from a text.
#pragma once
#include <lua.hpp>
#include <string>

#include "clench/base/watched.h"
#include "clench/io/text/memory_budget.h"

namespace clench {

/// Counts the memory that a Lua state allocates from its creation on, including garbage.
class LuaBudget {
 public:
  /// name, bytes  as of MemoryBudget
  LuaBudget(lua_State* L, std::string name, size_t bytes)
      : L_(L), counted_(memory(L)), budget_(std::move(name), bytes) {}

  /// Call for every value.
  /// throws  Error as MemoryBudget, and what check_stop() throws
  void check() {
    if (++values_ % values_between_checks != 0) return;
    check_stop();
    const size_t now = memory(L_);
    if (now <= counted_) return;
    budget_.take(now - counted_);
    counted_ = now;
  }

 private:
  static constexpr uint32_t values_between_checks = 1 << 8;

  static size_t memory(lua_State* L) {
    return (static_cast<size_t>(lua_gc(L, LUA_GCCOUNT)) << 10) +
           static_cast<size_t>(lua_gc(L, LUA_GCCOUNTB));
  }

  lua_State* L_;
  size_t counted_;
  MemoryBudget budget_;
  uint32_t values_ = 0;
};

}  // namespace clench
