#include "clench/script/lua/push.h"

#include <cmath>

#include "clench/base/error.h"
#include "clench/script/lua/kept.h"
#include "clench/script/lua/packed.h"
#include "clench/spec/valid.h"

namespace clench {

int push_nil(lua_State* L) {
  lua_pushnil(L);
  return 1;
}

int push(lua_State* L, double x) {
  if (!std::isfinite(x)) fail("{}: the result is not finite, got {}", subject(L), x);
  lua_pushnumber(L, x);
  return 1;
}

int push_unbounded(lua_State* L, double x) {
  lua_pushnumber(L, x);
  return 1;
}

int push(lua_State* L, bool b) {
  lua_pushboolean(L, b);
  return 1;
}

int push(lua_State* L, int n) {
  lua_pushinteger(L, n);
  return 1;
}

int push(lua_State* L, lua_Integer n) {
  lua_pushinteger(L, n);
  return 1;
}

int push(lua_State* L, std::string_view text) {
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

int push(lua_State* L, const char* text) {
  lua_pushstring(L, text);
  return 1;
}

int push(lua_State* L, const Eigen::Vector3d& v) {
  if (!v.allFinite())
    fail("{}: the result is not finite, got ({}, {}, {})", subject(L), v.x(), v.y(), v.z());
  return push_object(L, v);
}

int push(lua_State* L, const Pose& pose) {
  check_place(pose, subject(L));
  return push_object(L, pose);
}

int push(lua_State* L, std::span<const double> numbers) {
  return push_list_of(L, numbers, [L](double x) { lua_pushnumber(L, x); });
}

int push_rows(lua_State* L, const Eigen::MatrixXd& rows) {
  push_list(L, static_cast<int>(rows.rows()));
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    push(L, Eigen::VectorXd(rows.row(i)));
    lua_rawseti(L, -2, i + 1);
  }
  return 1;
}

void set_fields(lua_State* L, std::initializer_list<Field> fields) {
  for (const Field& field : fields) field.set(L);
}

int push_record(lua_State* L, std::initializer_list<Field> fields) {
  push_list(L, 0, static_cast<int>(fields.size()));
  set_fields(L, fields);
  return 1;
}

// print(list): implemented in the standard library
static int list_text(lua_State* L) {
  push_packed(L, "show");
  lua_pushvalue(L, 1);
  lua_call(L, 1, 1);
  return 1;
}

static const char list_key = 0;  // its address is the registry key of the lists' metatable

int push_list(lua_State* L, int expected_items, int expected_fields) {
  lua_createtable(L, expected_items, expected_fields);
  if (push_kept_table(L, &list_key)) {
    lua_pushcfunction(L, list_text);
    lua_setfield(L, -2, "__tostring");
    lua_pushboolean(L, 1);
    // its text shows its contents, so show need not call it again
    lua_setfield(L, -2, "__contents");
  }
  lua_setmetatable(L, -2);
  return 1;
}

}  // namespace clench
