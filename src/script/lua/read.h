// Lua values as C++ values, strictly: no strings for numbers, nothing infinite, and a sentence for
// what is wrong.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "clench/math/pose.h"
#include "clench/script/lua/stack.h"

namespace clench {

/// Whose value is read, for messages: "hand:autograsp: speed".
struct What {
  lua_State* L;
  std::string_view subject;  ///< empty: the entry that runs
  std::string key;           ///< empty: the value itself, as of a field that is set

  std::string text() const;
  What item(int i) const { return {L, subject, key + '[' + std::to_string(i) + ']'}; }
};

/// "a robot", "an object", "eigengrasps"
std::string with_article(std::string_view noun);

/// A value in a message: "3", "'abc'", "a table of 2", "a robot", "nothing".
std::string described(lua_State* L, int index);

/// throws  Error "subject: key: expected a number, got 'abc'"
[[noreturn]] void fail_expected(const What& what, std::string_view expected, int index);

// each throws Error as above; i is an index of the stack
double read_number(lua_State* L, int i, const What& what);    ///< finite
int64_t read_integer(lua_State* L, int i, const What& what);  ///< 2.0 is an integer too
int read_int(lua_State* L, int i, const What& what);          ///< within the range of int
bool read_boolean(lua_State* L, int i, const What& what);
std::string read_string(lua_State* L, int i, const What& what);    ///< without zero bytes
Eigen::Vector3d read_vec3(lua_State* L, int i, const What& what);  ///< a vec3 or {x, y, z}
/// a pose, or the table that clench.pose takes
Pose read_pose(lua_State* L, int i, const What& what);
/// How many items a list has: a table of the keys 1, 2, ... and none else but `extra`.
/// throws  Error "...: expected a list of contacts, got a table with the key 'link'"
int read_list_size(lua_State* L, int i, const What& what, std::string_view expected,
                   const char* extra = nullptr);
/// finite numbers; count < 0: any number of them
/// throws  Error "...: expected 12 numbers, got 3"
std::vector<double> read_numbers(lua_State* L, int i, const What& what, int count = -1);
/// 3 rows of 3
Eigen::Matrix3d read_matrix3(lua_State* L, int i, const What& what);
/// lists of numbers; columns < 0: any length
std::vector<std::vector<double>> read_rows(lua_State* L, int i, const What& what, int columns = -1);

}  // namespace clench
