// JSON text from and to Lua values. Numbers are preserved bit-exactly; objects are written with
// sorted keys.
#pragma once
#include <cstdint>
#include <lua.hpp>
#include <string>
#include <string_view>

namespace clench {

/// Pushes the value of a JSON text. null is clench.json.null in a list and absent from an object;
/// an empty object is marked, so that it is written as one.
/// max_values  maximum number of values, at all levels
/// throws  Error "clench.json.decode: line 3, column 14: expected ',' or '}', got 'x'"
///         Error::limit "clench.json.decode: expected at most 100 values"
void read_json(lua_State* L, std::string_view text, size_t max_values = SIZE_MAX);

/// Pushes a table with the texts of the items of a JSON list, or of the values of an object by
/// name. Of their syntax only strings and brackets are checked.
/// throws  as read_json does; each item counts as one value
void split_json(lua_State* L, std::string_view text, size_t max_values);

/// The value at the index as JSON text; indent 0: on one line. A table with items 1..n is a list,
/// one with names an object, an empty one a list unless read as an object. A metamethod __json can
/// return a value to write instead.
/// throws  Error "clench.json.encode: value.links[2]: expected ..., got a function"
std::string write_json(lua_State* L, int index, int indent = 0);

/// Pushes clench.json.null.
void push_json_null(lua_State* L);
/// Marks the table on top of the stack as an object, which matters if it is empty.
void mark_json_object(lua_State* L);

inline constexpr int json_depth = 100;  ///< maximum nesting of lists

}  // namespace clench
