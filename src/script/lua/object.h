// C++ values as Lua userdata: made by push_object, read by to, check_object (check.h) and self. Lua
// sees a userdata alone and not what its value owns besides: that is counted here, and collected by
// the guard (guard.h) where it has become much.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "clench/script/lua/lookup.h"
#include "clench/script/lua/owned.h"

namespace clench {

/// The Class that stands for T, a const Class* beside each class's declaration; null: scripts hold
/// no T.
template <class T>
inline constexpr std::nullptr_t script_class = nullptr;
template <class T>
concept Scripted = !std::is_null_pointer_v<decltype(script_class<T>)>;

template <class T>
const Class& class_of() {
  return *script_class<T>;
}

/// How a value lies in its userdata: aligned by hand, because Lua aligns to 8 bytes only.
template <class T>
struct Box {
  const Class* kind;
  bool alive;             ///< false after __gc or __close
  uint32_t owned_kb = 0;  ///< what Lua was told of
  alignas(T) unsigned char storage[sizeof(T)];

  T* value() { return std::launder(reinterpret_cast<T*>(storage)); }

  static Box* in(void* block) {
    const auto address = reinterpret_cast<uintptr_t>(block);
    return reinterpret_cast<Box*>((address + alignof(Box) - 1) & ~uintptr_t(alignof(Box) - 1));
  }
};

/// of a userdata, whose own place need not be aligned as the box
template <class T>
inline constexpr size_t box_bytes = sizeof(Box<T>) + alignof(Box<T>);

/// Does the value at the index have the class's metatable?
bool has_class(lua_State* L, int index, const Class& kind);

/// The T in the userdata at the index; null when it is something else or was closed.
template <class T>
T* to(lua_State* L, int index) {
  if (!has_class(L, index, class_of<T>())) return nullptr;
  if (lua_rawlen(L, index) != box_bytes<T>) return nullptr;
  auto* box = Box<T>::in(lua_touserdata(L, index));
  return box->kind == &class_of<T>() && box->alive ? box->value() : nullptr;
}

/// Bytes that a value owns besides its userdata, about; overloaded beside the classes whose values
/// own much. Shared parts count with whoever is sure to drop them last, or modestly.
template <class T>
size_t owned_bytes(const T&) {
  return 0;
}

/// Ends the value's life; a second call, or a foreign self, does nothing.
template <class T>
int close_object(lua_State* L) {
  if (T* value = to<T>(L, 1)) {
    auto* box = Box<T>::in(lua_touserdata(L, 1));
    box->alive = false;
    value->~T();
    if (box->owned_kb > 0) count_owned(L, -int64_t{box->owned_kb});
  }
  return 0;
}

/// The value at the index, which is a T, owns so many bytes more.
template <class T>
void add_owned(lua_State* L, int index, size_t bytes) {
  auto* box = Box<T>::in(lua_touserdata(L, index));
  const auto kilobytes = static_cast<uint32_t>(std::min(bytes >> 10, size_t{1} << 30));
  box->owned_kb += kilobytes;
  if (kilobytes > 0) count_owned(L, kilobytes);
}

/// Leaves a userdata with the value on the stack.
/// user_values  Lua values that it keeps besides, nil at first
/// returns  1
template <class T>
int push_object(lua_State* L, T value, int user_values = 0) {
  const Class& kind = class_of<T>();
  auto* box = Box<T>::in(lua_newuserdatauv(L, box_bytes<T>, user_values));
  box->kind = &kind;
  box->alive = false;  // until the value is in it
  box->owned_kb = 0;
  push_metatable(L, kind);
  if constexpr (!std::is_trivially_destructible_v<T>) {
    if (lua_rawgetp(L, -1, &kind) == LUA_TNIL) {
      lua_pushcfunction(L, close_object<T>);
      lua_setfield(L, -3, "__gc");
      lua_pushcfunction(L, close_object<T>);
      lua_setfield(L, -3, "__close");
      lua_pushboolean(L, 1);
      lua_rawsetp(L, -3, &kind);
    }
    lua_pop(L, 1);
  }
  lua_setmetatable(L, -2);
  new (box->storage) T(std::move(value));
  box->alive = true;
  if constexpr (!std::is_trivially_destructible_v<T>)
    if (const size_t bytes = owned_bytes(*box->value())) add_owned<T>(L, -1, bytes);
  return 1;
}

/// throws  Error "hand:autograsp: expected a robot before the colon, got a table;
///         use hand:autograsp(...)"
[[noreturn]] void fail_self(lua_State* L, const Class& kind);

struct What;
/// throws  Error "subject: expected a snapshot, got nil"
///         "subject: expected a snapshot, got one that was closed"
[[noreturn]] void fail_object(const What& what, const Class& kind, int index);

/// The object that a method or field belongs to.
template <class T>
T& self(lua_State* L) {
  if (T* object = to<T>(L, 1)) return *object;
  fail_self(L, class_of<T>());
}

}  // namespace clench
