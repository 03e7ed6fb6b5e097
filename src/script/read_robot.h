// What a call says of a robot beside its file.
#pragma once
#include "io/read.h"
#include "script/table.h"

namespace clench {

/// The keys folder, eigengrasps, virtual_contacts, package, close and approach of a call's options.
/// throws  Error that names the key and what is wrong
void read_robot_options(lua_State* L, Table& options, ReadOptions& reading);

}  // namespace clench
