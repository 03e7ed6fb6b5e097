// Positional arguments of a running entry: check_number(L, 1, "degrees"). Messages name entry and
// argument: "clench.rad: degrees: expected a number, got 'abc'". In a setter the value is argument
// 2 and has no name of its own.
#pragma once
#include "clench/script/lua/object.h"
#include "clench/script/lua/read.h"

namespace clench {

inline bool given(lua_State* L, int i) { return !lua_isnoneornil(L, i); }

inline double check_number(lua_State* L, int i, const char* name = "") {
  return read_number(L, i, {L, {}, name});
}
inline int check_int(lua_State* L, int i, const char* name = "") {
  return read_int(L, i, {L, {}, name});
}
inline int64_t check_integer(lua_State* L, int i, const char* name = "") {
  return read_integer(L, i, {L, {}, name});
}
inline bool check_boolean(lua_State* L, int i, const char* name = "") {
  return read_boolean(L, i, {L, {}, name});
}
inline std::string check_string(lua_State* L, int i, const char* name = "") {
  return read_string(L, i, {L, {}, name});
}
inline Eigen::Vector3d check_vec3(lua_State* L, int i, const char* name = "") {
  return read_vec3(L, i, {L, {}, name});
}
inline Pose check_pose(lua_State* L, int i, const char* name = "") {
  return read_pose(L, i, {L, {}, name});
}
inline std::vector<double> check_numbers(lua_State* L, int i, const char* name = "",
                                         int count = -1) {
  return read_numbers(L, i, {L, {}, name}, count);
}

/// A userdata of one class.
/// throws  Error "...: expected a robot, got a table"  "...: expected a snapshot, got one that was
///         closed"
template <class T>
T& check_object(lua_State* L, int i, const char* name = "") {
  if (T* object = to<T>(L, i)) return *object;
  fail_object({L, {}, name}, class_of<T>(), i);
}

}  // namespace clench
