// Memory that values own besides their userdata, which Lua does not see.
#pragma once
#include <cstdint>
#include <lua.hpp>

namespace clench {

/// Counts what values own from now on, or no longer.
void count_owned(lua_State* L, int64_t kilobytes);

/// Collects garbage when values own much more than after the last collection: by 64 MB, or by twice
/// what Lua's own memory is, which a collection goes through. Finalizers may run any code, so
/// nothing that they can close may be in use. Does nothing where a script has stopped the
/// collector.
void collect_owned(lua_State* L);

}  // namespace clench
