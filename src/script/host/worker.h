// Functions of scripts that run in a separate state, in another thread; used by clench.job and
// clench.parallel.map.
#pragma once
#include <lua.hpp>
#include <string>

#include "clench/script/bind/log.h"

namespace clench {

class State;

/// A function, and the settings that its new state copies from the calling one.
struct WorkerTask {
  std::string module, compiled;  // a module's name or the compiled function; the other is empty
  std::string name;              // chunk name of the function in messages, "=clench.job"
  std::string path, cpath;       // setting of require
  std::string script_folder, confine;
  LogLevel log_level = LogLevel::info;
  int nice = 0;  // niceness of the thread, see set_thread_nice
};

/// Reads the argument `task`: a function without upvalues other than _ENV, or the name of a module
/// that returns a function.
/// throws  Error "clench.job: function: it uses 'world' of the lines around it, ..."
WorkerTask read_worker_task(lua_State* L, int index);

/// An error that leaves a worker.
struct WorkerError {
  std::string words;  ///< empty: no error
  std::string kind;   ///< of a clench::Error; empty: an error of Lua
};

/// Pops an error value from the stack and converts it.
WorkerError take_worker_error(lua_State* L);

/// Prepares a new state for the task and pushes its function. State::end stops the state from now
/// on.
/// returns  false if that failed; `failure` has the error
bool open_worker(State& state, const WorkerTask& task, WorkerError& failure);

}  // namespace clench
