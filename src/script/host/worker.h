// What parallel.map and jobs share: a function of a script that runs in a state of its own, in
// another thread.
#pragma once
#include <lua.hpp>
#include <string>

#include "clench/script/bind/bind.h"

namespace clench {

class State;

/// A function as text or compiled, and what the state that runs it takes over from the one that
/// asks for it.
struct WorkerTask {
  std::string module, compiled;  // one of them
  std::string name;              // of the function in messages, "=clench.job"
  std::string path, cpath;       // of require
  std::string script_folder, confine;
  LogLevel log_level = LogLevel::info;
};

/// Reads the argument `task`: a function that uses nothing of the lines around it, or the name of a
/// module that returns a function.
/// throws  Error "clench.job: function: it uses 'world' of the lines around it, ..."
WorkerTask read_worker_task(lua_State* L, int index);

/// An error that leaves a worker.
struct WorkerError {
  std::string words;  ///< empty: there is none
  std::string kind;   ///< empty: an error of Lua's
};

/// Pops an error's value.
WorkerError take_worker_error(lua_State* L);

/// Makes a new state run the task, and leaves its function on the stack. From now on State::end stops
/// the state.
/// returns  false when it cannot, and says why
bool open_worker(State& state, const WorkerTask& task, WorkerError& failure);

}  // namespace clench
