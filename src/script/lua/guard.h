// The only bridge between C++ exceptions and Lua errors. It works with a Lua built as C, whose
// errors jump over frames without unwinding them, and with one built as C++, whose errors are
// exceptions of its own type: therefore never use catch (...) here, and raise errors only when no
// C++ object is alive.
#pragma once
#include <exception>
#include <lua.hpp>
#include <string_view>

#include "clench/base/error.h"

namespace clench {

/// The error kind with that name, as in error values.
/// throws  Error if there is none
ErrorKind error_kind(std::string_view name);

/// A Lua error passing through C++; its value is stored in the state, and guarded raises it again
/// unchanged.
class Raised : public std::exception {
 public:
  const char* what() const noexcept override { return "an error in a script's function"; }
};

/// Calls the function below its `arguments` on the stack.
/// throws  Raised if it fails
void protected_call(lua_State* L, int arguments, int results);

/// protected_call of a script's function. An error without a message, and a yield, become an error
/// that names the function.
/// subject  the function, for messages: "recording:each"
void call_script(lua_State* L, int arguments, int results, std::string_view subject);

/// As call_script, but leaves the value of an error on the stack.
/// returns  false when the function fails
bool try_script(lua_State* L, int arguments, int results, std::string_view subject);

/// Runs fn.
/// returns  its result, or -1 with an error value on top of the stack
int run_guarded(lua_State* L, lua_CFunction fn);

/// Pushes "a.lua:3: ", of the innermost function that is neither C nor of the standard library; ""
/// if there is none. Raises Lua errors for lack of memory, so no C++ object may be alive where
/// these jump.
void push_script_place(lua_State* L);

/// Pops the metatable to be used for error values.
void set_error_metatable(lua_State* L);
/// Pushes an error value with the script's line. Raises Lua errors only for lack of memory.
void push_error_value(lua_State* L, const char* sentence, const char* kind);

/// fn as a Lua function: a std::exception becomes a Lua error with the calling script's line.
template <lua_CFunction fn>
int guarded(lua_State* L) {
  const int results = run_guarded(L, fn);
  return results >= 0 ? results : lua_error(L);
}

}  // namespace clench
