// The scene that options of clench.render describe.
#pragma once
#include <span>

#include "clench/model/world.h"
#include "clench/scene/scene.h"
#include "clench/script/lua/table.h"

namespace clench {

/// Reads the options of the scene, and leaves size, quality and camera. Several worlds are states
/// of one, for a common view.
Scene read_scene(lua_State* L, Table& options, std::span<const World* const> states);

}  // namespace clench
