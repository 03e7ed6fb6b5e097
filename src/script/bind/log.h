// The log: the only thing that prints unasked. To stderr, or to a function of the script.
#pragma once
#include <string>

#include "clench/base/diagnostic.h"
#include "clench/script/lua/check.h"

namespace clench {

enum class LogLevel { debug, info, warning, error, quiet };

/// Tells the script's log, if its level lets the message through. May be called under the engine's
/// functions.
/// throws  Raised when the script's own sink fails
void log(lua_State* L, LogLevel level, const std::string& message);

inline void log_warning(lua_State* L, const std::string& message) {
  log(L, LogLevel::warning, message);
}

/// Is this the first time in this state that it is asked about that?
/// key  a static thing whose address stands for it
bool first_time(lua_State* L, const void* key, const std::string& about);

/// Tells a warning, with the script's line, and never again in this state.
/// key  a static thing whose address stands for it
void warn_once(lua_State* L, const void* key, const std::string& message);

/// Warns once where a distance is beyond 10 m, for which millimeters are a likely cause.
/// subject  what lies there
void suspect_millimeters(lua_State* L, const std::string& subject, double distance);

LogLevel log_level(lua_State* L);
void set_log_level(lua_State* L, LogLevel level);

/// Logs a diagnostic as its sentence, if the level lets it through. A sink gets its fields, too.
/// What concerns a file is printed once, even if the file is read several times.
/// throws  Raised when the script's own sink fails
void log(lua_State* L, const Diagnostic& diagnostic);

/// A sink for writers, and for grasps that are applied: what they report is logged as warnings that
/// are about nothing in particular.
Diagnostics log_losses(lua_State* L);

}  // namespace clench
