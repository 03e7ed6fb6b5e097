// The log: the only thing that prints unasked. To stderr, or to a script's function.
#pragma once
#include <string>

#include "script/entry.h"

namespace clench {

extern const Library log_library;

enum class LogLevel { debug, info, warning, error, quiet };

/// Tells the script's log, if its level lets the message through. May be called under the engine's
/// functions.
/// `about`  what a message of a file's reader tells: of what was "inferred", "ignored", "repaired" or "suspicious"; null: of nothing such
/// throws  Raised when the script's own sink fails
void log(lua_State* L, LogLevel level, const std::string& message, const char* about = nullptr);

inline void log_warning(lua_State* L, const std::string& message) {
  log(L, LogLevel::warning, message);
}

LogLevel log_level(lua_State* L);
void set_log_level(lua_State* L, LogLevel level);

}  // namespace clench
