// Functions of scripts in a run: hooks called at steps, tasks, listeners. They belong to a world in
// a Lua state.
#pragma once
#include "clench/script/bind/handles.h"

namespace clench {

/// Pushes the table of hooks of the world's runs, or nothing if there is none.
/// make     create an empty one if there is none
/// returns  true if there is a table
bool push_hooks(lua_State* L, const WorldPtr& world, bool make);

/// Calls the logs and recordings of a world that are due, as a run does before its first step and
/// after each step; stdlib/dynamics/observe.lua.
void call_observers(lua_State* L, const WorldPtr& world);

/// Runs a world, whose hooks are on top of the stack, for a duration [s];
/// stdlib/dynamics/control_loop.lua.
void run_with_hooks(lua_State* L, const WorldPtr& world, double duration);

}  // namespace clench
