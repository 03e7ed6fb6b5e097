// Fields that are read with one expression.
#pragma once
#include "clench/script/lua/guard.h"
#include "clench/script/lua/object.h"
#include "clench/script/lua/push.h"

namespace clench {

template <class Of, class Result, class Object>
Object object_of(Result (Of::*)(const Object&) const);

template <auto of>
int push_field(lua_State* L) {
  using Object = decltype(object_of(&decltype(of)::operator()));
  const auto value = of(self<Object>(L));
  if constexpr (std::is_convertible_v<decltype(value), std::span<const double>>)
    return push_numbers(L, value);
  else
    return push(L, value);
}

/// The function of a field's Entry: pushes what a lambda makes of the object, as
///     {"position", getter<[](const Pose& x) { return x.position; }>, R"(...)"}
template <auto of>
inline constexpr lua_CFunction getter = guarded<push_field<of>>;

}  // namespace clench
