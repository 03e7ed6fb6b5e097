// hand: what a robot has for grasping: eigengrasps, virtual contacts, a glove, sensors, tendons.
#pragma once
#include "motion/drive.h"
#include "script/handles.h"

namespace clench {

/// fields and methods of every robot
extern const Class hand_class;

/// What a drive came to: {moved, stops, stopped_by, queries, events}.
int push_drive(lua_State* L, const WorldPtr& world, const DriveResult& result);

}  // namespace clench
