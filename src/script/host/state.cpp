#include "clench/script/host/state.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <lua.hpp>

#include "clench/base/error.h"
#include "clench/base/printable.h"
#include "clench/base/watched.h"
#include "clench/script/bind/log.h"
#include "clench/script/host/modules.h"
#include "clench/script/host/open.h"
#include "clench/script/host/popen.h"
#include "clench/script/lua/chunks.h"
#include "clench/script/lua/deadline.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/watching.h"

namespace clench {

void* State::allocate(void* state, void* block, size_t old_size, size_t new_size) {
  Memory& m = static_cast<State*>(state)->memory_;
  if (!block) old_size = 0;  // without a block Lua passes the kind of object
  if (new_size > old_size && new_size - old_size > m.limit - m.used) return nullptr;
  if (new_size == 0) {
    std::free(block);
    m.used -= old_size;
    return nullptr;
  }
  void* grown = std::realloc(block, new_size);
  if (grown) m.used += new_size - old_size;
  return grown;
}

// errors of finalizers and similar code
void State::warn(void* state, const char* text, int to_be_continued) {
  Memory& m = static_cast<State*>(state)->memory_;
  if (m.warning.empty() && !to_be_continued && *text == '@') return;  // a control message
  m.warning += text;
  if (to_be_continued) return;
  if (!m.quiet) write_above_bar(fmt::format("clench: warning: {}\n", printable(m.warning, "\n\t")));
  m.warning.clear();
}

// an error outside protected calls is an internal error
static int panic(lua_State* L) {
  const char* text = lua_tostring(L, -1);
  std::fprintf(stderr, "clench: unprotected error: %s\n", text ? text : "no text");
  return 0;
}

static constexpr int all_events = LUA_MASKCALL | LUA_MASKRET | LUA_MASKCOUNT;

// Lua reports the coroutine that it enters or returns to
int State::track(lua_State* L) {
  auto* state = static_cast<State*>(lua_touserdata(L, lua_upvalueindex(1)));
  lua_State* thread = lua_tothread(L, 1);
  if (!thread) return 0;
  state->running_.store(thread, std::memory_order_relaxed);
  // a coroutine that was waiting at the interruption, too
  if (state->interrupts_ > 0) lua_sethook(thread, on_hook, all_events, 1);
  return 0;
}

static int open_all(lua_State* L) {
  // environment variables for modules are read by add_user_modules
  lua_pushboolean(L, 1);
  lua_setfield(L, LUA_REGISTRYINDEX, "LUA_NOENV");
  luaL_openlibs(L);
  replace_popen(L);
  refuse_bytecode(L);
  add_user_modules(L);
  luaL_requiref(L, "clench", clench_open, 1);
  lua_pop(L, 1);
  add_bare_names(L);
  push_packed(L, "error_text");  // loaded before a script can change what it needs
  lua_pop(L, 1);
  // passes our tracker to the module that wraps coroutines
  push_packed(L, "host.coroutines");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 0);
  return 0;
}

// a script that requests more memory gets an error, before the machine runs out of it
static size_t default_memory_limit() {
  const auto pages = static_cast<size_t>(sysconf(_SC_PHYS_PAGES));
  return pages / 4 * 3 * static_cast<size_t>(sysconf(_SC_PAGESIZE));
}

size_t State::memory_of(lua_State* L) {
  void* state = nullptr;
  return lua_getallocf(L, &state) == &State::allocate ? static_cast<State*>(state)->memory_.limit
                                                      : default_memory_limit();
}

State::State(size_t memory) {
  memory_.limit = memory > 0 ? memory : default_memory_limit();
  L_ = lua_newstate(allocate, this);
  if (!L_) fail(ErrorKind::limit, "clench: no memory for Lua");
  running_.store(L_, std::memory_order_relaxed);
  lua_atpanic(L_, panic);
  lua_setwarnf(L_, warn, this);
  lua_pushcfunction(L_, open_all);
  lua_pushlightuserdata(L_, this);
  lua_pushcclosure(L_, track, 1);
  if (lua_pcall(L_, 1, 0, 0) == LUA_OK) {
    bar_ = bar_of(L_);
    return;
  }
  const char* text = lua_tostring(L_, -1);
  const std::string message = text ? text : "cannot open Lua's libraries";
  lua_close(L_);
  throw Error(message);
}

State::~State() { lua_close(L_); }

void State::set_script(const std::string& path) {
  const auto folder = std::filesystem::path(path).parent_path();
  set_setting(L_, Setting::modules, folder.empty() ? "." : folder.string());
}

void State::set_confine(const std::string& folder) {
  std::error_code code;
  const auto path = std::filesystem::canonical(folder, code);
  if (code || !std::filesystem::is_directory(path, code))
    fail("--confine: expected a folder, got '{}'", folder);
  set_setting(L_, Setting::confine, path.string());
}

void State::set_quiet() {
  memory_.quiet = true;
  set_log_level(L_, LogLevel::error);
}

// --- errors ---

// any error value as text, with the traceback
static int explain(lua_State* L) {
  lua_sethook(L, nullptr, 0, 0);  // the run ends here: nothing interrupts the output of the reason
  lua_settop(L, 1);
  push_packed(L, "error_text");
  lua_pushvalue(L, 1);
  if (lua_pcall(L, 1, 1, 0) != LUA_OK)
    lua_pushliteral(L, "error object that cannot be converted to text");
  lua_replace(L, 1);
  lua_settop(L, 1);
  // a traceback's own text would end at a zero byte
  lua_pushliteral(L, "\n");
  luaL_traceback(L, L, nullptr, 1);
  lua_concat(L, 3);
  return 1;
}

// os.exit if the script must not end the program; upvalue: destination of the report
static int on_exit(lua_State* L) {
  auto* asked = static_cast<std::string*>(lua_touserdata(L, lua_upvalueindex(1)));
  // the nearest line of a script: the caller may be pcall, or a finalizer without one
  lua_pushliteral(L, "");
  lua_Debug caller;
  for (int level = 1; lua_rawlen(L, -1) == 0 && lua_getstack(L, level, &caller); ++level)
    luaL_where(L, level);
  lua_pushliteral(L, "os.exit: a file that is read cannot end the program");
  lua_concat(L, 2);
  if (asked->empty()) *asked = lua_tostring(L, -1);
  return lua_error(L);
}

static int replace_exit(lua_State* L) {
  lua_getglobal(L, LUA_OSLIBNAME);
  lua_pushvalue(L, 1);
  lua_pushcclosure(L, on_exit, 1);
  lua_setfield(L, -2, "exit");
  return 0;
}

void State::refuse_exit(std::string& asked) {
  lua_pushcfunction(L_, replace_exit);
  lua_pushlightuserdata(L_, &asked);
  if (lua_pcall(L_, 1, 0, 0) != LUA_OK) lua_pop(L_, 1);
}

// also in a signal handler [s]
static double now() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// time that code which catches an interruption may take [s]
#ifdef __SANITIZE_ADDRESS__
// everything takes several times as long
static constexpr double patience = 3;
#else
static constexpr double patience = 0.5;
#endif

// Code that catches the interruption may call the engine; that call, too, ends with its patience.
void State::remind() {
  if (reminder_) return;
  try {
    reminder_ = std::make_unique<Deadline>(bar_, patient_until_ - now(), &Bar::interrupt);
  } catch (const std::exception&) {
    bar_->interrupt();  // no thread: the next call ends at once
  }
}

void State::on_hook(lua_State* L, lua_Debug*) {
  void* data = nullptr;
  lua_getallocf(L, &data);
  State& state = *static_cast<State*>(data);
  const bool again = state.interrupts_ > 1 || now() > state.patient_until_;
  // the first request may already have ended another coroutine or a call of the engine
  const bool first = state.bar_->take_all();
  // raised at every instruction from now on, so that a script that catches the error ends, too
  lua_sethook(L, on_hook, all_events, again ? 1 : 1000);
  if (!again) state.remind();
  if (!again && !first) return;
  push_error_value(L, "interrupted", "stopped");
  lua_error(L);
}

void State::interrupt() {
  if (interrupts_ == 0) patient_until_ = now() + patience;
  ++interrupts_;
  bar_->interrupt();
  lua_sethook(L_, on_hook, all_events, 1);
  lua_State* running = running_.load(std::memory_order_relaxed);
  if (running != L_) lua_sethook(running, on_hook, all_events, 1);
}

// waits until `resume` or `end` is called
void State::hold() {
  if (on_hold_) on_hold_(true);
  paused_.wait(true);
  if (on_hold_) on_hold_(false);
}

void State::on_count(lua_State* L, lua_Debug*) {
  void* data = nullptr;
  lua_getallocf(L, &data);
  State& state = *static_cast<State*>(data);
  if (!state.ended_ && state.paused_) state.hold();
  if (!state.ended_) return;
  // raised at every instruction from now on, so that a script that catches the error ends, too
  lua_sethook(L, on_count, LUA_MASKCOUNT, 1);
  push_error_value(L, "stopped", "stopped");
  lua_error(L);
}

void State::look_for_end() { lua_sethook(L_, on_count, LUA_MASKCOUNT, 1000); }

void State::end() {
  ended_ = true;
  bar_->stop_for_good();
  resume();
}

bool State::is_paused(lua_State* L) {
  void* state = nullptr;
  return lua_getallocf(L, &state) == &State::allocate && static_cast<State*>(state)->paused_;
}

void State::resume() {
  paused_ = false;
  paused_.notify_all();
}

// pops the results of a call down to base
State::Result State::finish(int status, int base) {
  lua_sethook(L_, nullptr, 0, 0);
  reminder_.reset();
  bar_->take_all();
  interrupts_ = 0;
  running_.store(L_, std::memory_order_relaxed);
  Result result;
  result.ok = status == LUA_OK;
  for (int i = base + 1; i <= lua_gettop(L_); ++i) {
    size_t size = 0;
    const char* text = lua_type(L_, i) == LUA_TSTRING ? lua_tolstring(L_, i, &size) : nullptr;
    std::string value = text ? std::string(text, size) : std::string(luaL_typename(L_, i));
    if (result.ok)
      result.values.push_back(std::move(value));
    else
      result.error = std::move(value);
  }
  lua_settop(L_, base);
  return result;
}

// --- running; code that can fail for lack of memory runs inside lua_pcall ---

struct Arguments {
  const std::string& path;
  const std::vector<std::string>& list;
};

static int make_arguments(lua_State* L) {
  const auto& arguments = *static_cast<const Arguments*>(lua_touserdata(L, 1));
  lua_createtable(L, static_cast<int>(arguments.list.size()), 1);
  lua_pushstring(L, arguments.path.c_str());
  lua_rawseti(L, -2, 0);
  for (size_t i = 0; i < arguments.list.size(); ++i) {
    lua_pushstring(L, arguments.list[i].c_str());
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_setglobal(L, "arg");
  return 0;
}

void State::set_arguments(const std::string& path, const std::vector<std::string>& arguments) {
  Arguments all{path, arguments};
  lua_pushcfunction(L_, make_arguments);
  lua_pushlightuserdata(L_, &all);
  if (lua_pcall(L_, 1, 0, 0) != LUA_OK) lua_pop(L_, 1);
}

static bool push_strings(lua_State* L, const std::vector<std::string>& strings) {
  if (!lua_checkstack(L, static_cast<int>(strings.size()) + 10)) return false;
  for (const auto& text : strings) lua_pushlstring(L, text.data(), text.size());
  return true;
}

// below is a chunk, or a message with the reason for its absence
State::Result State::run_loaded(int status, const std::vector<std::string>& arguments) {
  const int base = lua_gettop(L_) - 1;
  const Watched watched{Progress(bar_)};
  if (status != LUA_OK) return finish(status, base);
  lua_pushcfunction(L_, explain);
  lua_insert(L_, base + 1);
  if (!push_strings(L_, arguments)) {
    lua_settop(L_, base);
    return {false, "too many arguments", {}};
  }
  status = lua_pcall(L_, static_cast<int>(arguments.size()), LUA_MULTRET, base + 1);
  lua_remove(L_, base + 1);
  return finish(status, base);
}

State::Result State::run_file(const std::string& path, const std::vector<std::string>& arguments) {
  set_arguments(path, arguments);
  if (path != "-") set_script(path);
  return run_loaded(load_text_file(L_, path == "-" ? nullptr : path.c_str()), arguments);
}

State::Result State::run_code(const std::string& code, const std::string& name) {
  return run_loaded(load_text(L_, code.data(), code.size(), name.c_str()), {});
}

// (module, function, arguments...)
static int call_packed(lua_State* L) {
  lua_rotate(L, 1, -1);  // the module after its function and the arguments
  take_packed_function(L, lua_tostring(L, -1));
  lua_pop(L, 1);
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  for (int i = 1; i <= lua_gettop(L); ++i) {
    luaL_tolstring(L, i, nullptr);
    lua_replace(L, i);
  }
  return lua_gettop(L);
}

State::Result State::call(const std::string& module, const std::string& function,
                          const std::vector<std::string>& arguments) {
  std::vector<std::string> all{module, function};
  all.insert(all.end(), arguments.begin(), arguments.end());
  lua_pushcfunction(L_, call_packed);
  return run_loaded(LUA_OK, all);
}

// --- the console ---

// prints its arguments in the format of the console, and stores the first one as `_`
static int show_results(lua_State* L) {
  const int count = lua_gettop(L);
  if (count == 0) return 0;
  luaL_checkstack(L, 8, "too many results to show");
  if (!lua_isnil(L, 1)) {
    lua_pushglobaltable(L);
    lua_pushliteral(L, "_");
    lua_pushvalue(L, 1);
    lua_rawset(L, -3);
    lua_pop(L, 1);
  }
  for (int i = 1; i <= count; ++i) {
    push_packed(L, "show");
    lua_pushvalue(L, i);
    lua_call(L, 1, 1);
    size_t size = 0;
    const char* text = lua_tolstring(L, -1, &size);
    std::fwrite(text, 1, size, stdout);
    std::fputc(i < count ? '\t' : '\n', stdout);
    lua_pop(L, 1);
  }
  std::fflush(stdout);
  return 0;
}

// (function of host.session, arguments...)
static int call_session(lua_State* L) {
  take_packed_function(L, "host.session");
  lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
  return lua_gettop(L);
}

State::Line State::evaluate(const std::string& input, int line) {
  const int base = lua_gettop(L_), handler = base + 1, chunk = base + 2;
  const Watched watched{Progress(bar_)};
  lua_pushcfunction(L_, explain);
  lua_pushcfunction(L_, call_session);
  lua_pushliteral(L_, "compile");
  lua_pushlstring(L_, input.data(), input.size());
  lua_pushinteger(L_, line);
  int status = lua_pcall(L_, 3, 3, handler);
  if (status == LUA_OK && lua_isnil(L_, chunk)) {
    if (lua_toboolean(L_, -1)) {
      lua_settop(L_, base);
      return Line::incomplete;
    }
    lua_pop(L_, 1);
    lua_replace(L_, chunk);
    status = LUA_ERRSYNTAX;
  }
  if (status == LUA_OK) {
    const bool keeps = lua_toboolean(L_, chunk + 1);
    lua_settop(L_, chunk);
    status = lua_pcall(L_, 0, LUA_MULTRET, handler);
    if (status == LUA_OK && keeps) {
      lua_pushcfunction(L_, call_session);
      lua_pushliteral(L_, "keep");
      lua_rotate(L_, chunk, 2);
      status = lua_pcall(L_, lua_gettop(L_) - chunk, 0, handler);
    } else if (status == LUA_OK) {
      lua_pushcfunction(L_, show_results);
      lua_insert(L_, chunk);
      status = lua_pcall(L_, lua_gettop(L_) - chunk, 0, handler);
    }
  }
  lua_remove(L_, handler);
  const Result result = finish(status, base);
  if (!result.ok) fmt::print(stderr, "{}\n", printable(result.error, "\n\t"));
  return result.ok ? Line::done : Line::failed;
}

}  // namespace clench
