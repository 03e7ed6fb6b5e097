#include <algorithm>
#include <cstdio>
#include <iterator>
#include <vector>

#include "clench/base/printable.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/script/bind/log.h"
#include "clench/script/bind/plain/plain.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/watching.h"

namespace clench {

static const char* const level_names[] = {"debug", "info", "warning", "error", "quiet"};

// addresses are the registry keys of the state's level and sink, and of logged messages
static const char level_key = 0, sink_key = 0, of_file_key = 0;

LogLevel log_level(lua_State* L) {
  const bool set = lua_rawgetp(L, LUA_REGISTRYINDEX, &level_key) == LUA_TNUMBER;
  const auto level = set ? static_cast<LogLevel>(lua_tointeger(L, -1)) : LogLevel::info;
  lua_pop(L, 1);
  return level;
}

void set_log_level(lua_State* L, LogLevel level) {
  lua_pushinteger(L, static_cast<int>(level));
  lua_rawsetp(L, LUA_REGISTRYINDEX, &level_key);
}

// of the enumerators of About
static const char* const about_names[] = {nullptr, "inferred", "ignored", "repaired", "suspicious"};

static const char* severity_name(Severity severity) {
  return severity == Severity::note ? "note" : severity == Severity::warning ? "warning" : "error";
}

// {severity =, file =, line =, subject =, text =, about =, count =}
static void push_fields(lua_State* L, const Diagnostic& diagnostic) {
  lua_createtable(L, 0, 7);
  const auto set = [L](const char* name, const std::string& value) {
    if (value.empty()) return;
    lua_pushlstring(L, value.data(), value.size());
    lua_setfield(L, -2, name);
  };
  set("severity", severity_name(diagnostic.severity));
  set("file", diagnostic.place.file);
  set("subject", diagnostic.place.subject);
  set("text", diagnostic.text);
  if (const char* about = about_names[static_cast<int>(diagnostic.about)]) set("about", about);
  if (diagnostic.place.line > 0) {
    lua_pushinteger(L, diagnostic.place.line);
    lua_setfield(L, -2, "line");
  }
  lua_pushinteger(L, diagnostic.count);
  lua_setfield(L, -2, "count");
}

// equal for equal diagnostics only
static std::string value_key(const Diagnostic& d) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}", severity_name(d.severity), d.place.file,
                     d.place.line, d.place.subject, d.text, d.count);
}

// The strings among the running function's arguments, which distinguish files of the same name.
static std::string argument_text(lua_State* L) {
  std::string out;
  for (int i = 1; i <= std::min(2, lua_gettop(L)); ++i)
    if (lua_type(L, i) == LUA_TSTRING) out += "\n" + std::string(string_at(L, i));
  return out;
}

// Calls the script's sink, if there is one.   `fields`: pushes the values of a diagnostic
static bool call_sink(lua_State* L, LogLevel level, const std::string& message, const char* about,
                      const Diagnostic* fields) {
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &sink_key) != LUA_TFUNCTION) {
    lua_pop(L, 1);
    return false;
  }
  lua_pushstring(L, level_names[static_cast<int>(level)]);
  lua_pushlstring(L, message.data(), message.size());
  lua_pushstring(L, about);  // nil when null
  if (fields)
    push_fields(L, *fields);
  else
    lua_pushnil(L);
  call_script(L, 4, 0, "clench.log.sink");
  return true;
}

static void print_message(LogLevel level, const std::string& message, const char* kept) {
  write_above_bar(fmt::format("clench: {}: {}\n", level_names[static_cast<int>(level)],
                              printable(message, kept)));
}

void log(lua_State* L, LogLevel level, const std::string& message) {
  if (!lua_checkstack(L, 8) || level < log_level(L)) return;
  if (!call_sink(L, level, message, nullptr, nullptr)) print_message(level, message, "\n\t");
}

void log(lua_State* L, const Diagnostic& diagnostic) {
  const LogLevel level = diagnostic.severity == Severity::note      ? LogLevel::info
                         : diagnostic.severity == Severity::warning ? LogLevel::warning
                                                                    : LogLevel::error;
  if (!lua_checkstack(L, 8) || level < log_level(L)) return;
  const char* about = about_names[static_cast<int>(diagnostic.about)];
  const std::string sentence = diagnostic.sentence();
  if (call_sink(L, level, sentence, about, &diagnostic)) return;
  // what concerns a file is logged once, even if the file is read several times
  if (about && !first_time(L, &of_file_key, value_key(diagnostic) + argument_text(L))) return;
  print_message(level, sentence, "");  // one line, whatever names it quotes
}

Diagnostics log_losses(lua_State* L) {
  return Diagnostics([L](Diagnostic loss) {
    loss.about = About::none;
    log(L, loss);
  });
}

bool first_time(lua_State* L, const void* key, const std::string& about) {
  push_kept_table(L, key);
  const bool told = lua_getfield(L, -1, about.c_str()) == LUA_TBOOLEAN;
  lua_pushboolean(L, true);
  lua_setfield(L, -3, about.c_str());
  lua_pop(L, 2);
  return !told;
}

void warn_once(lua_State* L, const void* key, const std::string& message) {
  if (!first_time(L, key, "")) return;
  push_script_place(L);
  const std::string place = lua_tostring(L, -1);
  lua_pop(L, 1);
  log_warning(L, place + message);
}

// the arguments as text, separated by spaces
static std::string joined(lua_State* L) {
  std::string text;
  const int count = lua_gettop(L);
  for (int i = 1; i <= count; ++i) {
    lua_pushcfunction(L, [](lua_State* state) {
      luaL_tolstring(state, 1, nullptr);
      return 1;
    });
    lua_pushvalue(L, i);
    call_script(L, 1, 1, fmt::format("{}: argument {}", subject(L), i));
    if (i > 1) text += ' ';
    text += string_at(L, -1);
    lua_pop(L, 1);
  }
  return text;
}

template <LogLevel level>
static int log_at(lua_State* L) {
  log(L, level, joined(L));
  return 0;
}

static int level(lua_State* L) {
  const LogLevel before = log_level(L);
  if (given(L, 1)) {
    const std::string name = check_string(L, 1, "name");
    const auto* end = std::end(level_names);
    const auto* found = std::find(std::begin(level_names), end, name);
    const std::vector<std::string> known(std::begin(level_names), end);
    if (found == end)
      fail("{}: expected one of {}, got '{}'{}", subject(L), name_list(known), name,
           did_you_mean(name, known));
    set_log_level(L, static_cast<LogLevel>(found - level_names));
  }
  return push(L, level_names[static_cast<int>(before)]);
}

static int sink(lua_State* L) {
  if (given(L, 1) && lua_type(L, 1) != LUA_TFUNCTION)
    fail_expected({L, {}, "fn"}, "a function or nil", 1);
  lua_settop(L, 1);
  lua_rawsetp(L, LUA_REGISTRYINDEX, &sink_key);
  return 0;
}

// the script's sink and level during its lifetime; then the previous ones, of which the sink is at
// an index of the stack
class OtherSink {
 public:
  OtherSink(lua_State* L, int before) : L_(L), before_(before), level_(log_level(L)) {
    set_log_level(L, LogLevel::info);
  }
  ~OtherSink() {
    lua_pushvalue(L_, before_);
    lua_rawsetp(L_, LUA_REGISTRYINDEX, &sink_key);
    set_log_level(L_, level_);
  }
  OtherSink(const OtherSink&) = delete;
  OtherSink& operator=(const OtherSink&) = delete;

 private:
  lua_State* L_;
  int before_;
  LogLevel level_;
};

// (f, arguments...)
static int collect(lua_State* L) {
  if (lua_type(L, 1) != LUA_TFUNCTION) fail_expected({L, {}, "f"}, "a function", 1);
  const int count = lua_gettop(L) - 1;
  lua_rawgetp(L, LUA_REGISTRYINDEX, &sink_key);
  lua_insert(L, 1);
  push_packed(L, "collected_log");
  protected_call(L, 0, 2);
  lua_insert(L, 2);  // the list, below the function
  lua_rawsetp(L, LUA_REGISTRYINDEX, &sink_key);
  const OtherSink sink(L, 1);
  call_script(L, count, LUA_MULTRET, subject(L));
  return lua_gettop(L) - 1;
}

static const Entry log_functions[] = {
    {"collect", guarded<collect>, R"(
Calls a function, and returns the messages logged during the call as values. Notes, warnings and errors are collected at every level; nothing is printed, and no sink is called.
@param f function  function to call
@param ... any  its arguments
@return {severity: "note"|"warning"|"error", text: string, file?: string, line?: integer, subject?: string, about?: string, count: integer}[] diagnostics  file and line: the place in a file that is read or written; subject: the part of it that is concerned, "joint 2"; about: "inferred", "ignored", "repaired" or "suspicious"; equal problems of one file are one, the first, with their count
@return any ...  what the function returns
@effect edits
> list, body = clench.log.collect(function() return world:add_object(flask.source, {name = "again"}) end)
> body.name, #list  --> again, 0
> list = clench.log.collect(clench.log.warning, "too thin")
> list[1].severity, list[1].text  --> warning, too thin
> clench.log.collect(3)  --> error: f: expected a function, got 3)"},
    {"debug", guarded<log_at<LogLevel::debug>>, R"(
Logs a message for developers.
@param ... any  values of the message, as print takes them
@effect reads
> clench.log.debug "not shown by default"
> clench.log.level()  --> info)"},
    {"info", guarded<log_at<LogLevel::info>>, R"(
Logs a message of possible interest to users.
@param ... any  values of the message, as print takes them
@effect reads
> clench.log.sink(function(level, text) said = level .. ": " .. text end)
> clench.log.info("three", 3)
> clench.log.sink()
> said  --> info: three 3)"},
    {"warning", guarded<log_at<LogLevel::warning>>, R"(
Logs a warning, such as contents of a file that the engine does not use.
@param ... any  values of the message, as print takes them
@effect reads
> clench.log.sink(function(level, text) said = level .. ": " .. text end)
> clench.log.warning "no mass given"
> clench.log.sink()
> said  --> warning: no mass given)"},
    {"error", guarded<log_at<LogLevel::error>>, R"(
Logs an error, and continues.
@param ... any  values of the message, as print takes them
@effect reads
> clench.log.sink(function(level, text) said = level .. ": " .. text end)
> clench.log.error "the glove does not answer"
> clench.log.sink()
> said  --> error: the glove does not answer)"},
    {"level", guarded<level>, R"(
Sets the level from which on messages are shown, if one is given; returns the previous one.
@param name? "debug"|"info"|"warning"|"error"|"quiet"  least severe level that is printed; without it the level stays
@return string before
@effect edits
> clench.log.level "quiet"  --> info
> clench.log.level "info"  --> quiet
> clench.log.level "loud"  --> error: expected one of debug, info, warning, error, quiet)"},
    {"sink", guarded<sink>, R"(
Sends messages to a function(level, text, about, diagnostic) instead of stderr; without one, to stderr again. `about` is the kind
of message of a file reader: "inferred", "ignored", "repaired" or "suspicious"; nil otherwise. `diagnostic` contains a message of
a reader or writer as values, like `clench.log.collect`; nil for messages of scripts.
@param fn? fun(level: string, text: string, about: string?, diagnostic: table?)  called with each message in place of printing it; without it messages are printed again
@effect edits
> clench.log.sink(function(level, text) said = text end)
> clench.log.info "hello"
> clench.log.sink()
> said  --> hello)"},
};

const Library log_library{.name = "clench.log",
                          .doc =
                              "Messages of scripts and of the engine, to stderr, so that they "
                              "never mix with a script's output.",
                          .functions = log_functions};

}  // namespace clench
