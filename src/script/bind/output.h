// Output files named by scripts.
#pragma once
#include <string>

struct lua_State;

namespace clench {

/// Argument i, a file to be written; checked as check_target does with the folder of the state.
std::string check_output(lua_State* L, int i, const char* name = "path");

}  // namespace clench
