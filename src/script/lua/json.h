// JSON text from and to Lua values. Numbers come back to the bit; objects are written with their
// keys sorted.
#pragma once
#include <lua.hpp>
#include <string>
#include <string_view>

namespace clench {

/// Leaves the value of a JSON text on the stack. null is clench.json.null in a list and absent from
/// an object; an empty object comes back as one when written again.
/// throws  Error "clench.json.decode: line 3, column 14: expected ',' or '}', got 'x'"
void read_json(lua_State* L, std::string_view text);

/// The value at the index as JSON text; indent 0: on one line. A table with items 1..n is a list,
/// one with names an object, an empty one a list unless read as an object. A metamethod __json
/// gives a value to write instead.
/// throws  Error "clench.json.encode: value.links[2]: expected ..., got a function"
std::string write_json(lua_State* L, int index, int indent = 0);

/// Leaves clench.json.null.
void push_json_null(lua_State* L);
/// Marks the table on top of the stack as an object, even when it is empty.
void mark_json_object(lua_State* L);

inline constexpr int json_depth = 100;  ///< lists in lists at most

}  // namespace clench
