#include "clench/script/host/worker.h"

#include <cstdlib>
#include <string_view>

#include "clench/base/error.h"
#include "clench/script/host/state.h"
#include "clench/script/lua/guard.h"
#include "clench/script/lua/packed.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/read.h"
#include "clench/script/lua/setting.h"
#include "clench/script/lua/stack.h"
#include "clench/script/lua/watching.h"

namespace clench {

// --- in the calling state ---

static int write_chunk(lua_State*, const void* data, size_t size, void* to) {
  static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
  return 0;
}

static std::string package_path(lua_State* L, const char* field) {
  std::string out;
  if (lua_getglobal(L, LUA_LOADLIBNAME) == LUA_TTABLE) {
    lua_pushstring(L, field);
    if (lua_rawget(L, -2) == LUA_TSTRING) out = string_at(L, -1);
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
  return out;
}

static void read_function(lua_State* L, int index, WorkerTask& task) {
  if (lua_type(L, index) == LUA_TSTRING) {
    task.module = string_at(L, index);
    return;
  }
  if (!lua_isfunction(L, index))
    fail_expected({L, "", "task"}, "a function or a module's name", index);
  for (int i = 1; const char* name = lua_getupvalue(L, index, i); ++i) {
    lua_pop(L, 1);
    if (std::string_view(name) != "_ENV" || i > 1)
      fail(
          "{}: function: it uses '{}' of the lines around it, which other states do not have; pass "
          "it in an option, or as a part of an argument",
          subject(L), name);
  }
  lua_pushvalue(L, index);
  if (lua_dump(L, write_chunk, &task.compiled, 0) != 0)
    fail("{}: function: expected one written in Lua", subject(L));
  lua_pop(L, 1);
}

WorkerTask read_worker_task(lua_State* L, int index) {
  WorkerTask task;
  read_function(L, index, task);
  task.name = "=" + subject(L);
  task.path = package_path(L, "path");
  task.cpath = package_path(L, "cpath");
  task.script_folder = get_setting(L, Setting::modules);
  task.confine = get_setting(L, Setting::confine);
  task.log_level = log_level(L);
  task.nice = std::atoi(get_setting(L, Setting::worker_nice).c_str());
  return task;
}

// --- in the worker's state ---

static void set_path(lua_State* L, const char* field, const std::string& path) {
  lua_getglobal(L, LUA_LOADLIBNAME);
  lua_pushlstring(L, path.data(), path.size());
  lua_setfield(L, -2, field);
  lua_pop(L, 1);
}

// (task) -> function
static int prepare(lua_State* L) {
  const auto& task = *static_cast<const WorkerTask*>(lua_touserdata(L, 1));
  set_path(L, "path", task.path);
  set_path(L, "cpath", task.cpath);
  // a hook set by the function would replace the one that stops it
  lua_getglobal(L, LUA_DBLIBNAME);
  lua_pushnil(L);
  lua_setfield(L, -2, "sethook");
  lua_pop(L, 1);
  if (task.module.empty()) {
    const int status =
        luaL_loadbufferx(L, task.compiled.data(), task.compiled.size(), task.name.c_str(), "b");
    if (status != LUA_OK) fail("{}", string_at(L, -1));
    // its only upvalue is _ENV, which becomes the globals of this state
    lua_pushglobaltable(L);
    if (!lua_setupvalue(L, -2, 1)) lua_pop(L, 1);
    return 1;
  }
  lua_getglobal(L, "require");
  lua_pushlstring(L, task.module.data(), task.module.size());
  protected_call(L, 1, 1);
  if (!lua_isfunction(L, -1))
    fail("module '{}': expected one that returns a function, got {}", task.module,
         described(L, -1));
  return 1;
}

// (error value) -> its message, its kind or nil
static int tell_error(lua_State* L) {
  push_packed(L, "error_text");
  lua_pushvalue(L, 1);
  protected_call(L, 1, 1);
  if (!lua_istable(L, 1)) return 1;
  lua_pushliteral(L, "kind");
  lua_rawget(L, 1);
  return 2;
}

WorkerError take_worker_error(lua_State* L) {
  const auto words = [&](int index) {
    return lua_type(L, index) == LUA_TSTRING ? std::string(string_at(L, index)) : std::string();
  };
  const int top = lua_gettop(L) - 1;
  lua_pushcfunction(L, guarded<tell_error>);
  lua_insert(L, -2);
  WorkerError out;
  // the message is made without interruption, also for a task that was stopped
  const lua_Hook hook = lua_gethook(L);
  const int mask = lua_gethookmask(L), count = lua_gethookcount(L);
  lua_sethook(L, nullptr, 0, 0);
  if (lua_pcall(L, 1, 2, 0) == LUA_OK) out = {words(-2), words(-1)};
  lua_sethook(L, hook, mask, count);
  if (out.words.empty()) out.words = "an error without a message";
  lua_settop(L, top);
  return out;
}

bool open_worker(State& state, const WorkerTask& task, WorkerError& failure) {
  lua_State* L = state.lua();
  if (!task.script_folder.empty()) set_setting(L, Setting::modules, task.script_folder);
  if (!task.confine.empty()) set_setting(L, Setting::confine, task.confine);
  if (task.nice > 0) set_setting(L, Setting::worker_nice, std::to_string(task.nice));
  set_log_level(L, task.log_level);
  bar_of(L)->hide();  // the bar of the calling state shows the common progress
  state.look_for_end();
  lua_pushcfunction(L, guarded<prepare>);
  lua_pushlightuserdata(L, const_cast<WorkerTask*>(&task));
  if (lua_pcall(L, 1, 1, 0) == LUA_OK) return true;
  failure = take_worker_error(L);
  return false;
}

}  // namespace clench
