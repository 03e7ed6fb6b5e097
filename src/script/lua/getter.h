// Fields, and methods without arguments, that consist of one expression.
#pragma once
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"
#include "clench/script/lua/read.h"

namespace clench {

// the object of a field, or the substitute used for several classes
template <class T>
decltype(auto) receiver(lua_State* L) {
  if constexpr (requires { T::from_self(L); })
    return T::from_self(L);
  else
    return self<T>(L);
}

// unary + converts a lambda to a function pointer
template <class Result, class Object>
int push_result(lua_State* L, Result (*of)(Object&)) {
  auto&& object = receiver<std::remove_const_t<Object>>(L);
  if constexpr (std::is_void_v<Result>)
    return of(object), 0;
  else
    return push(L, of(object));
}
template <auto of>
int push_field(lua_State* L) {
  return push_result(L, +of);
}

template <class Object, class Value>
int set_result(lua_State* L, void (*set)(Object&, Value)) {
  auto&& object = receiver<std::remove_const_t<Object>>(L);
  set(object, read_as<std::remove_cvref_t<Value>>(L, 2, {L, {}, ""}));
  return 0;
}
template <auto set>
int set_field_by(lua_State* L) {
  return set_result(L, +set);
}

template <class T>
int push_equality(lua_State* L) {
  const auto *a = to<T>(L, 1), *b = to<T>(L, 2);
  return push(L, a && b && *a == *b);
}

/// The function of an Entry: pushes the result of a function or a lambda for the object, as
///     {"position", getter<[](const Pose& x) { return x.position; }>, R"(...)"}
template <auto of>
inline constexpr lua_CFunction getter = guarded<push_field<of>>;

/// The same for a method without arguments, or an operator; it may return nothing.
template <auto of>
inline constexpr lua_CFunction method = getter<of>;

/// The setter of a field: calls a function or a lambda with the object and the new value, as
///     setter<[](const BodyHandle& x, const Pose& pose) { x.world->set_pose(x.id, pose); }>
template <auto set>
inline constexpr lua_CFunction setter = guarded<set_field_by<set>>;

/// "__eq" of a class, by the == of its type.
template <class T>
inline constexpr lua_CFunction equality = guarded<push_equality<T>>;

}  // namespace clench
