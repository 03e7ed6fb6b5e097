// A script's function that the engine may call, as long as the script waits for the engine.
#pragma once
#include <functional>
#include <lua.hpp>
#include <memory>

namespace clench {

/// The state that calls the engine now: a coroutine's, or the main one.
class CallingState {
 public:
  /// It is L until this ends; then again what it was.
  explicit CallingState(lua_State* L);
  ~CallingState() { *current_ = before_; }
  CallingState(const CallingState&) = delete;
  CallingState& operator=(const CallingState&) = delete;

 private:
  std::shared_ptr<lua_State*> current_;
  lua_State* before_;
};

/// The function at the index, which gives a number. It lives as long as the result, or a copy of
/// it, does, and may be called where a CallingState is.
/// throws  when called: Raised, where the function fails; Error when it gives no number, or nobody
///         waits
std::function<double()> script_number(lua_State* L, int index);

}  // namespace clench
