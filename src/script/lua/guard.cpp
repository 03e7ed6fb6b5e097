#include "clench/script/lua/guard.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>

#include "clench/base/printable.h"
#include "clench/base/progress.h"
#include "clench/base/text.h"
#include "clench/script/lua/entry.h"
#include "clench/script/lua/owned.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/watching.h"

namespace clench {

// its address is the registry key of the metatable of error values
static const char error_key = 0;

void set_error_metatable(lua_State* L) { lua_rawsetp(L, LUA_REGISTRYINDEX, &error_key); }

static constexpr const char* packed_source = "@stdlib/";

void push_script_place(lua_State* L) {
  lua_Debug info;
  for (int level = 0; lua_getstack(L, level, &info); ++level) {
    lua_getinfo(L, "Sl", &info);
    if (info.currentline <= 0 ||
        std::strncmp(info.source, packed_source, std::strlen(packed_source)) == 0)
      continue;
    lua_pushfstring(L, "%s:%d: ", info.short_src, info.currentline);
    return;
  }
  lua_pushliteral(L, "");
}

void push_error_value(lua_State* L, const char* sentence, const char* kind) {
  push_script_place(L);
  lua_pushstring(L, sentence);
  if (lua_rawgetp(L, LUA_REGISTRYINDEX, &error_key) != LUA_TTABLE)
    return lua_pop(L, 1), lua_concat(L, 2);
  lua_createtable(L, 0, 3);
  lua_rotate(L, -4, 1);  // value, place, sentence, metatable
  lua_setmetatable(L, -4);
  lua_setfield(L, -3, "sentence");
  lua_setfield(L, -2, "place");
  lua_pushstring(L, kind);
  lua_setfield(L, -2, "kind");
}

static const char raised_key = 0;  // its address is the registry key of the waiting error value

// the error's value is on top of the stack
[[noreturn]] static void raise_later(lua_State* L) {
  lua_rawsetp(L, LUA_REGISTRYINDEX, &raised_key);
  throw Raised();
}

void protected_call(lua_State* L, int arguments, int results) {
  if (lua_pcall(L, arguments, results, 0) != LUA_OK) raise_later(L);
}

// (error value) -> the value that the caller gets; upvalue: the subject
static int explain_callback(lua_State* L) {
  lua_settop(L, 1);
  push_packed(L, "callback_error");
  lua_insert(L, 1);
  lua_pushvalue(L, lua_upvalueindex(1));
  lua_call(L, 2, 1);
  return 1;
}

bool try_script(lua_State* L, int arguments, int results, std::string_view subject) {
  const int handler = lua_gettop(L) - arguments;
  lua_pushlstring(L, subject.data(), subject.size());
  lua_pushcclosure(L, explain_callback, 1);
  lua_insert(L, handler);
  const bool ok = lua_pcall(L, arguments, results, handler) == LUA_OK;
  lua_remove(L, handler);
  return ok;
}

void call_script(lua_State* L, int arguments, int results, std::string_view subject) {
  if (!try_script(L, arguments, results, subject)) raise_later(L);
}

// `at`, or slightly less if it would cut a UTF-8 character
static size_t character_at(std::string_view text, size_t at) {
  for (int back = 0; back < 3 && at > 0 && (text[at] & 0xC0) == 0x80; ++back) --at;
  return at;
}

// message of an exception, in printable form, in memory that needs no destructor
struct Message {
  // maximum length: longer texts are cut
  static constexpr size_t longest = 1000, kept_end = 250;
  char text[longest + 1];

  // without control characters, which a terminal would interpret; long texts keep both ends
  void copy(std::string_view what) {
    std::string_view first = what, last;
    if (what.size() > longest) {
      first = what.substr(0, character_at(what, longest - kept_end - 3));
      last = what.substr(character_at(what, what.size() - kept_end + 3));
    }
    char* end = std::ranges::copy(first, text).out;
    if (!last.empty()) end = std::ranges::copy(last, std::strcpy(end, "...") + 3).out;
    *make_printable(text, end) = 0;
  }
  // for errors that are not ours, such as those of the standard library
  void copy(lua_State* L, std::string_view what) {
    try {
      copy(fmt::format("{}: {}", subject(L), what));
    } catch (const std::bad_alloc&) {
      copy(what);
    }
  }
};

enum class Failure { none, raised, stopped, message };

static constexpr const char* kind_names[] = {"input", "file", "stale", "limit", "internal"};

static const char* name_of(ErrorKind kind) { return kind_names[static_cast<int>(kind)]; }

ErrorKind error_kind(std::string_view name) {
  const auto found = std::ranges::find(kind_names, name);
  if (found == std::end(kind_names)) fail("expected a kind of errors, got {}", in_quotes(name));
  return static_cast<ErrorKind>(found - std::begin(kind_names));
}

// at most as many arguments as the entry takes
static void check_count(lua_State* L) {
  const auto allowed = static_cast<int>(lua_tointeger(L, lua_upvalueindex(at_max_arguments)));
  const int count = lua_gettop(L) - (running_class(L) ? 1 : 0);
  if (allowed >= 0 && running_entry(L) && count > allowed)
    fail("{}: expected {} argument{}, got {}", subject(L),
         allowed == 0 ? "no" : fmt::format("at most {}", allowed), allowed == 1 ? "" : "s", count);
}

static Failure run_caught(lua_State* L, lua_CFunction fn, int& results, Message& message,
                          ErrorKind& kind) {
  try {
    check_count(L);
    results = fn(L);
    return Failure::none;
  } catch (const Raised&) {
    return Failure::raised;
  } catch (const Stopped&) {
    return Failure::stopped;
  } catch (const Error& e) {
    message.copy(e.what());
    kind = e.kind();
  } catch (const std::bad_alloc&) {
    message.copy(L, "not enough memory");
    kind = ErrorKind::limit;
  } catch (const std::length_error&) {  // request larger than any memory
    message.copy(L, "not enough memory");
    kind = ErrorKind::limit;
  } catch (const std::exception& e) {
    message.copy(L, e.what());
    kind = ErrorKind::internal;
  }
  return Failure::message;
}

int run_guarded(lua_State* L, lua_CFunction fn) {
  int results = 0;
  Message message;
  ErrorKind kind = ErrorKind::input;
  const Failure failure = run_caught(L, fn, results, message, kind);
  if (failure == Failure::none) {
    // the results are on the stack, and no C++ object is alive
    collect_owned(L);
    return results;
  }

  // outside the handler only plain memory is alive
  lua_settop(L, 0);
  // if both requested a stop, this error is the deadline's, and the user's request raises the next
  // one
  const bool out_of_time = failure == Failure::stopped && bar_of(L)->take_end_of_time();
  if (failure == Failure::stopped && !out_of_time) bar_of(L)->take_all();
  if (failure == Failure::raised) {
    lua_rawgetp(L, LUA_REGISTRYINDEX, &raised_key);
    lua_pushnil(L);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &raised_key);
  } else {
    const bool stopped = failure == Failure::stopped;
    push_error_value(L,
                     out_of_time ? "out of time"
                     : stopped   ? "interrupted"
                                 : message.text,
                     out_of_time ? "timeout"
                     : stopped   ? "stopped"
                                 : name_of(kind));
  }
  return -1;
}

}  // namespace clench
