// C++ values onto Lua's stack: push(L, value), overloaded for further types elsewhere. Lists and
// records print their contents. Each function returns 1. Numbers, vectors and poses given to
// scripts are valid as arguments: an overflow is an error "vec3: the result is not finite, got
// (inf, 0, 0)".
#pragma once
#include <Eigen/Core>
#include <initializer_list>
#include <lua.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "clench/script/lua/values.h"

namespace clench {

int push_nil(lua_State* L);
int push(lua_State* L, double x);
int push_unbounded(lua_State* L, double x);  ///< a number that may be infinite
int push(lua_State* L, bool b);
int push(lua_State* L, int n);
int push(lua_State* L, lua_Integer n);
int push(lua_State* L, std::string_view text);
int push(lua_State* L, const char* text);
int push(lua_State* L, const Eigen::Vector3d& v);          ///< a vec3
int push(lua_State* L, const Pose& pose);                  ///< one that satisfies check_place
int push(lua_State* L, std::span<const double> numbers);   ///< a list
int push_rows(lua_State* L, const Eigen::MatrixXd& rows);  ///< a list of lists

/// An empty table that prints its contents; fill it with lua_rawseti and set_field.
int push_list(lua_State* L, int expected_items = 0, int expected_fields = 0);

/// A list of the values that push_item(item) pushes, one for each item of a range.
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

/// A vec3 of three numbers, a list of others, a list of lists of a matrix.
template <class Derived>
int push(lua_State* L, const Eigen::MatrixBase<Derived>& m) {
  if constexpr (Derived::ColsAtCompileTime != 1) {
    return push_rows(L, m);
  } else if constexpr (Derived::RowsAtCompileTime == 3) {
    return push(L, Eigen::Vector3d(m));
  } else {
    const Eigen::VectorXd v = m;
    return push(L, std::span<const double>(v.data(), static_cast<size_t>(v.size())));
  }
}

template <class T>
concept ListItem = !std::is_same_v<T, double>;  // lists of numbers are pushed unchanged

/// An object of a class; nil for a null pointer.
template <Scripted T>
int push(lua_State* L, const T& value) {
  if constexpr (std::is_constructible_v<bool, const T&>)
    if (!value) return push_nil(L);
  return push_object(L, value);
}

template <class T>
int push(lua_State* L, const std::optional<T>& value) {
  return value ? push(L, *value) : push_nil(L);
}

template <ListItem T>
int push(lua_State* L, std::span<const T> list) {
  return push_list_of(L, list, [L](const T& item) { push(L, item); });
}
template <ListItem T>
int push(lua_State* L, const std::vector<T>& list) {
  return push(L, std::span<const T>(list));
}

/// A table indexed by names; its numbers may be infinite.
template <class T>
int push(lua_State* L, const std::map<std::string, T>& named) {
  push_list(L, 0, static_cast<int>(named.size()));
  for (const auto& [name, value] : named) {
    if constexpr (std::is_same_v<T, double>)
      push_unbounded(L, value);
    else
      push(L, value);
    lua_setfield(L, -2, name.c_str());
  }
  return 1;
}

/// A key of a record, and its value, or a function that pushes the value: either must live until
/// the record is pushed. A nil value adds no field.
class Field {
 public:
  template <class T>
  Field(const char* key, const T& value)
      : key_(key), value_(&value), push_([](lua_State* L, const void* of) {
          const T& here = *static_cast<const T*>(of);
          if constexpr (std::is_invocable_v<const T&>)
            here();
          else
            push(L, here);
        }) {}

  void set(lua_State* L) const {
    push_(L, value_);
    lua_setfield(L, -2, key_);
  }

 private:
  const char* key_;
  const void* value_;
  void (*push_)(lua_State* L, const void* value);
};

/// Sets a field of the table on top of the stack.
template <class T>
void set_field(lua_State* L, const char* key, const T& value) {
  Field(key, value).set(L);
}

void set_fields(lua_State* L, std::initializer_list<Field> fields);

/// A table of these fields: push_record(L, {{"low", low}, {"high", high}}).
int push_record(lua_State* L, std::initializer_list<Field> fields);

}  // namespace clench
