// Lua values as C++ values, with strict checks: no strings as numbers, nothing infinite, and an
// error message for invalid values.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "clench/math/pose.h"
#include "clench/script/lua/stack.h"

namespace clench {

/// Name of the value being read, for messages: "hand:autograsp: speed".
struct What {
  lua_State* L;
  std::string_view subject;  ///< empty: the running entry
  std::string key;           ///< empty: the value itself, for example of a field being set

  std::string text() const;
  What item(int i) const { return {L, subject, key + '[' + std::to_string(i) + ']'}; }
  What named(std::string_view name) const;
};

/// "a robot", "an object", "eigengrasps"
std::string with_article(std::string_view noun);

/// A value in a message: "3", "'abc'", "a table of 2", "a robot", "nothing".
std::string described(lua_State* L, int index);

/// throws  Error "subject: key: expected a number, got 'abc'"
[[noreturn]] void fail_expected(const What& what, std::string_view expected, int index);

// each throws Error as above; i is an index of the stack
double read_number(lua_State* L, int i, const What& what);    ///< finite
int64_t read_integer(lua_State* L, int i, const What& what);  ///< 2.0 is also an integer
int read_int(lua_State* L, int i, const What& what);          ///< within the range of int
bool read_boolean(lua_State* L, int i, const What& what);
std::string read_string(lua_State* L, int i, const What& what);    ///< without zero bytes
Eigen::Vector3d read_vec3(lua_State* L, int i, const What& what);  ///< a vec3 or {x, y, z}
/// a pose, or the table that clench.pose accepts
Pose read_pose(lua_State* L, int i, const What& what);
/// Number of items in a list: a table with the keys 1, 2, ... and no others except `extra`.
/// throws  Error "...: expected a list of contacts, got a table with the key 'link'"
int read_list_size(lua_State* L, int i, const What& what, std::string_view expected,
                   const char* extra = nullptr);
/// The sorted names in a table {name = value}, so that the first reported fault is always the same.
/// numbers  receives the keys that are ints, sorted; null: those are rejected like all others
/// throws   Error "...: expected names of variables as keys, got 3"
std::vector<std::string> read_keys(lua_State* L, int table, const What& what,
                                   std::string_view expected, std::vector<int>* numbers = nullptr);
/// finite numbers; count < 0: any number of them
/// throws  Error "...: expected 12 numbers, got 3"
std::vector<double> read_numbers(lua_State* L, int i, const What& what, int count = -1);
Eigen::VectorXd vector_of(const std::vector<double>& numbers);
/// 3 rows of 3
Eigen::Matrix3d read_matrix3(lua_State* L, int i, const What& what);
/// lists of numbers; columns < 0: any length
std::vector<std::vector<double>> read_rows(lua_State* L, int i, const What& what, int columns = -1);

/// Rows of six as columns.
Eigen::Matrix<double, 6, Eigen::Dynamic> columns_of(const std::vector<std::vector<double>>& rows);

/// One of the above, by its type; an optional one is empty for nil.
template <class T>
T read_as(lua_State* L, int i, const What& what) {
  if constexpr (std::is_same_v<T, double>) {
    return read_number(L, i, what);
  } else if constexpr (std::is_same_v<T, int>) {
    return read_int(L, i, what);
  } else if constexpr (std::is_same_v<T, bool>) {
    return read_boolean(L, i, what);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return read_string(L, i, what);
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    return read_vec3(L, i, what);
  } else if constexpr (std::is_same_v<T, Eigen::Matrix3d>) {
    return read_matrix3(L, i, what);
  } else if constexpr (std::is_same_v<T, Pose>) {
    return read_pose(L, i, what);
  } else {
    return lua_isnoneornil(L, i) ? T() : read_as<typename T::value_type>(L, i, what);
  }
}

/// Calls read(index, what) with each item of a list, on top of the stack.
/// throws  as read_list_size, and what read throws
template <class Read>
void each_item(lua_State* L, int list, const What& what, std::string_view expected, Read read,
               const char* extra = nullptr) {
  list = lua_absindex(L, list);
  const int count = read_list_size(L, list, what, expected, extra);
  for (int i = 1; i <= count; ++i) {
    lua_rawgeti(L, list, i);
    read(lua_gettop(L), what.item(i));
    lua_pop(L, 1);
  }
}

/// Calls read(name, index, what) with each value of a table {name = value}, on top of the stack.
/// throws  as read_keys, and what read throws
template <class Read>
void each_named(lua_State* L, int table, const What& what, std::string_view expected, Read read,
                std::vector<int>* numbers = nullptr) {
  table = lua_absindex(L, table);
  for (const std::string& name : read_keys(L, table, what, expected, numbers)) {
    lua_pushlstring(L, name.data(), name.size());
    lua_rawget(L, table);
    read(name, lua_gettop(L), what.named(name));
    lua_pop(L, 1);
  }
}

}  // namespace clench
