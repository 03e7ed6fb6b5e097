// A script's function that the engine may call while the script waits for the engine.
#pragma once
#include <functional>
#include <lua.hpp>
#include <memory>

namespace clench {

/// The Lua thread that is calling the engine: a coroutine, or the main one.
class CallingState {
 public:
  /// Sets it to L during its lifetime, then restores the previous one.
  explicit CallingState(lua_State* L);
  ~CallingState() { *current_ = before_; }
  CallingState(const CallingState&) = delete;
  CallingState& operator=(const CallingState&) = delete;

 private:
  std::shared_ptr<lua_State*> current_;
  lua_State* before_;
};

/// The function at the index, which must return a number. It lives as long as the result or a copy
/// of it, and may be called while there is a CallingState.
/// throws  when called: Raised, if the function fails; Error if it returns no number, or there is
///         no CallingState
std::function<double()> script_number(lua_State* L, int index);

}  // namespace clench
