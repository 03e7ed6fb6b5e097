// C++ values onto Lua's stack. Lists and records print their contents. Each function returns 1.
// Numbers, vectors and poses that scripts are given can be given back: what overflowed is an error
// "vec3: the result is not finite, got (inf, 0, 0)".
#pragma once
#include <Eigen/Core>
#include <lua.hpp>
#include <span>
#include <string_view>

#include "clench/script/lua/values.h"

namespace clench {

int push(lua_State* L, double x);
int push_unbounded(lua_State* L, double x);  ///< of which infinity is a value, too
int push(lua_State* L, bool b);
int push(lua_State* L, int n);
int push(lua_State* L, lua_Integer n);
int push(lua_State* L, std::string_view text);
int push(lua_State* L, const char* text);
int push(lua_State* L, const Eigen::Vector3d& v);                 ///< a vec3
int push(lua_State* L, const Pose& pose);                         ///< one that check_place allows
int push_numbers(lua_State* L, std::span<const double> numbers);  ///< a list
int push_rows(lua_State* L, const Eigen::MatrixXd& rows);         ///< a list of lists

/// An empty table that prints what will be in it; fill it with lua_rawseti and set_field.
int push_list(lua_State* L, int expected_items = 0, int expected_fields = 0);

/// Sets a field of the table on top of the stack.
template <class T>
void set_field(lua_State* L, const char* key, const T& value) {
  push(L, value);
  lua_setfield(L, -2, key);
}

/// A list of what push_item(item) leaves on the stack, one for each item of a range.
template <class Range, class PushItem>
int push_list_of(lua_State* L, const Range& range, PushItem push_item) {
  push_list(L, static_cast<int>(std::size(range)));
  int i = 0;
  for (const auto& item : range) {
    push_item(item);
    lua_rawseti(L, -2, ++i);
  }
  return 1;
}

}  // namespace clench
