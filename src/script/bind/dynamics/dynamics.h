// Dynamics of worlds, bodies and robots for scripts.
#pragma once
#include "clench/script/bind/handles.h"
#include "clench/script/lua/table.h"

namespace clench {

/// fields and methods of every world, of every body and robot, and of every robot
extern const Class world_dynamics_class, world_control_class, motion_class, joint_dynamics_class,
    robot_dynamics_class;

/// The key `dynamics` of the options of a new world.
DynamicSettings read_dynamic_settings(Table& options);

}  // namespace clench
