// The scene that options of clench.render describe.
#pragma once
#include <span>

#include "clench/model/world.h"
#include "clench/scene/scene.h"
#include "clench/script/lua/table.h"

namespace clench {

/// Reads what is drawn, which leaves size, quality and camera in the options. Several worlds are
/// states of one, for a view of all.
Scene read_scene(lua_State* L, Table& options, std::span<const World* const> states);

}  // namespace clench
