#include "clench/script/host/natives.h"

#include "clench/base/hash.h"
#include "clench/base/printable.h"
#include "clench/base/suggest.h"
#include "clench/script/bind/port/natives.h"
#include "clench/script/host/bind_poller.h"
#include "clench/script/lua/check.h"
#include "clench/script/lua/deadline.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/watching.h"

namespace clench {

// raise(sentence, kind): an error at the script's line, "input" unless a kind is given
static int raise(lua_State* L) {
  // a name given by a script may contain zero bytes
  const std::string sentence =
      lua_type(L, 1) == LUA_TSTRING ? std::string(string_at(L, 1)) : check_string(L, 1);
  throw Error(sentence, given(L, 2) ? error_kind(check_string(L, 2)) : ErrorKind::input);
}

// call_script(subject, fn, ...): returns the values of the script's function; its errors name the
// subject
static int call_script(lua_State* L) {
  const std::string subject = check_string(L, 1, "subject");
  call_script(L, lua_gettop(L) - 2, LUA_MULTRET, subject);
  return lua_gettop(L) - 1;
}

// script_line(): "a.lua:3: ", the line of the script that called the standard library, or ""
static int script_line(lua_State* L) {
  push_script_place(L);
  return 1;
}

// suggest(name, known): "; did you mean 'count'?", or "" if none is near, or if the name is not a
// string
static int suggest(lua_State* L) {
  std::vector<std::string> known;
  const bool named = lua_type(L, 1) == LUA_TSTRING && lua_istable(L, 2);
  for (lua_Integer i = 1; named && lua_rawgeti(L, 2, i) == LUA_TSTRING; ++i) {
    known.emplace_back(string_at(L, -1));
    lua_pop(L, 1);
  }
  return push(L, known.empty() ? "" : did_you_mean(string_at(L, 1), known));
}

// printable(text, kept): the text with '?' in place of each character that a terminal or a page
// would interpret; `kept`: characters that are not replaced, such as "\n\t"
static int make_printable(lua_State* L) {
  if (lua_type(L, 1) != LUA_TSTRING) check_string(L, 1, "text");  // text may have zero bytes
  const auto kept = given(L, 2) ? string_at(L, 2) : std::string_view();
  return push(L, printable(string_at(L, 1), kept));
}

// fingerprint(text): 16 hexadecimal digits, equal for equal texts on all platforms
static int fingerprint(lua_State* L) {
  Hasher hasher;
  hasher.add(string_at(L, 1));
  return push(L, fmt::format("{:016x}", hasher.value()));
}

// packed_text(path): the file "plan/sample.lua" of the standard library, or nil
static int packed_text(lua_State* L) {
  for (const PackedFile& file : packed_files())
    if (file.path == string_at(L, 1)) return push(L, file.text);
  lua_pushnil(L);
  return 1;
}

using DeadlinePtr = std::shared_ptr<Deadline>;

// deadline:close(): ends the deadline.   returns  true if the time has passed
static int close_deadline(lua_State* L) { return push(L, self<DeadlinePtr>(L)->close()); }

static const Entry deadline_methods[] = {{"close", guarded<close_deadline>, ""}};
static const Class deadline_class{
    .name = "deadline", .variable = "deadline", .doc = "", .methods = deadline_methods};
template <>
inline constexpr const Class* script_class<DeadlinePtr> = &deadline_class;

// deadline(seconds): after this time, the running call of the engine fails once, as by Ctrl-C
static int deadline(lua_State* L) {
  return push_object(L, std::make_shared<Deadline>(bar_of(L), check_number(L, 1, "seconds")));
}

void add_natives(lua_State* L) {
  static constexpr luaL_Reg natives[] = {{"clench.raise", guarded<raise>},
                                         {"clench.call_script", guarded<call_script>},
                                         {"clench.script_line", script_line},
                                         {"clench.suggest", guarded<suggest>},
                                         {"clench.deadline", guarded<deadline>},
                                         {"clench.printable", guarded<make_printable>},
                                         {"clench.fingerprint", guarded<fingerprint>},
                                         {"clench.packed_text", guarded<packed_text>},
                                         {"clench.poller", guarded<new_poller>},
                                         {"clench.has_jobs", guarded<has_jobs>},
                                         {"clench.open_serial", guarded<open_serial_stream>},
                                         {"clench.open_pty", guarded<open_pty_stream>},
                                         {"clench.open_pair", guarded<open_stream_pair>},
                                         {"clench.open_stdio", guarded<open_stdio_stream>},
                                         {"clench.begin_connect", guarded<begin_stream>},
                                         {"clench.open_acceptor", guarded<open_acceptor>},
                                         {"clench.resolve_host", guarded<resolve_host>},
                                         {"clench.save_secret", guarded<save_secret>},
                                         {"clench.canonical", guarded<canonical_path>},
                                         {nullptr, nullptr}};
  luaL_getsubtable(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
  luaL_setfuncs(L, natives, 0);
  lua_pop(L, 1);
}

}  // namespace clench
