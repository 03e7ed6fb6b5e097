// The log: the only unrequested output. To stderr, or to a function of the script.
#pragma once
#include <string>

#include "clench/base/diagnostic.h"
#include "clench/script/lua/check.h"

namespace clench {

enum class LogLevel { debug, info, warning, error, quiet };

/// Passes a message to the script's log, if its level permits. May be called by functions of the
/// engine.
/// throws  Raised if the script's own sink fails
void log(lua_State* L, LogLevel level, const std::string& message);

inline void log_warning(lua_State* L, const std::string& message) {
  log(L, LogLevel::warning, message);
}

/// Is this the first call with that key in this state?
/// key  a static object identified by its address
bool first_time(lua_State* L, const void* key, const std::string& about);

/// Logs a warning, with the script's line, once per state.
/// key  a static object identified by its address
void warn_once(lua_State* L, const void* key, const std::string& message);

/// Warns once if a distance exceeds 10 m, which is probably due to millimeters.
/// subject  name of the distant thing
void suspect_millimeters(lua_State* L, const std::string& subject, double distance);

LogLevel log_level(lua_State* L);
void set_log_level(lua_State* L, LogLevel level);

/// Logs the message of a diagnostic if the level permits it. A sink receives its fields, too.
/// Diagnostics of a file are printed once, even if the file is read several times.
/// throws  Raised when the script's sink fails
void log(lua_State* L, const Diagnostic& diagnostic);

/// A sink for writers, and for grasps that are applied: their diagnostics are logged as warnings
/// without a category.
Diagnostics log_losses(lua_State* L);

}  // namespace clench
