// Applies a grasp to a world, and identifies it there.
#pragma once
#include <lua.hpp>

#include "clench/grasp/wrench/grasp.h"

namespace clench {

/// Stores fingerprints and the version with a grasp that was measured in that world.
void note_identity(lua_State* L, const World& world, Grasp& grasp);

/// (grasp, world, options): as grasp:apply
int apply_by_script(lua_State* L);

/// (grasp, hand, options): as grasp:dofs_for
int grasp_dofs_for(lua_State* L);

}  // namespace clench
