// Memory owned by values outside their userdata, which is invisible to Lua.
#pragma once
#include <cstdint>
#include <lua.hpp>

namespace clench {

/// Adds or removes owned memory.
void count_owned(lua_State* L, int64_t kilobytes);

/// Collects garbage if values own much more than after the last collection: by 64 MB, or by twice
/// Lua's own memory, which a collection traverses. Finalizers may run any code, so nothing that
/// they can close may be in use. Does nothing if a script has stopped the collector.
void collect_owned(lua_State* L);

}  // namespace clench
