// body: an object, an obstacle or a part of a robot.
#pragma once
#include "motion/move.h"
#include "script/bind_entity.h"
#include "script/handles.h"

namespace clench {

/// What a move came to: {fraction, touched, stopped_by, queries}.
int push_move(lua_State* L, const WorldPtr& world, const MoveResult& result);

}  // namespace clench
