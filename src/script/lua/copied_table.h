// Detects assignments to parts of tables that fields return: these are copies.
#pragma once
#include <cstddef>

struct lua_State;

namespace clench {

/// Stores the text of a chunk that is not in a file, such as a line of the console, under its name;
/// a later chunk of the same name replaces it.
void keep_chunk_text(lua_State* L, const char* text, size_t size, const char* name);

/// To be called by a metamethod that returns the field `key` of `owner` and has left a table on top
/// of the stack. Looks at the line of the script that reads the field.
/// throws  Error if the line assigns to a part of it, as in "hand.dofs[2] = 0.3" or
///         "world.dynamics.time_step = 0.01", which would change only a copy
void check_part_not_assigned(lua_State* L, const char* owner, const char* key);

}  // namespace clench
