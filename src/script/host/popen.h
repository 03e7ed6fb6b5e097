// io.popen for states in several threads.
#pragma once
#include <lua.hpp>

namespace clench {

/// Replaces io.popen, which flushes all open files of the process, and so would wait for each
/// thread that is reading from a program: a file of the new one is not locked while it is read.
void replace_popen(lua_State* L);

}  // namespace clench
