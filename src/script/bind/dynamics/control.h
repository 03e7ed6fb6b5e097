// Scripts that take part in a run: functions called at steps, tasks, listeners. They belong to a
// world in a state of Lua.
#pragma once
#include "clench/script/bind/handles.h"

namespace clench {

/// Leaves the table of what takes part in the world's runs on the stack, or nothing where there is
/// none.
/// make    an empty one where there is none
/// returns is it there?
bool push_hooks(lua_State* L, const WorldPtr& world, bool make);

/// Calls the logs and recordings of a world that are due, as a run does before its first step and
/// after each step; stdlib/dynamics/observe.lua.
void call_observers(lua_State* L, const WorldPtr& world);

/// Runs a world whose hooks are on top of the stack for so long [s];
/// stdlib/dynamics/control_loop.lua.
void run_with_hooks(lua_State* L, const WorldPtr& world, double duration);

}  // namespace clench
