// C++ values as Lua userdata: created by push_object, read by to, check_object (check.h) and self.
// Lua sees only the size of the userdata and not the memory owned by its value: that is counted
// here, and the guard (guard.h) collects garbage if it has become large.
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

/// The Class of T, a const Class* next to each class's declaration; null: scripts have no T.
template <class T>
inline constexpr std::nullptr_t script_class = nullptr;
template <class T>
concept Scripted = !std::is_null_pointer_v<decltype(script_class<T>)>;

template <class T>
const Class& class_of() {
  return *script_class<T>;
}

/// Layout of a value in its userdata: aligned explicitly, because Lua aligns only to 8 bytes.
template <class T>
struct Box {
  const Class* kind;
  bool alive;             ///< false after __gc or __close
  uint32_t owned_kb = 0;  ///< memory reported to Lua
  alignas(T) unsigned char storage[sizeof(T)];

  T* value() { return std::launder(reinterpret_cast<T*>(storage)); }

  static Box* in(void* block) {
    const auto address = reinterpret_cast<uintptr_t>(block);
    return reinterpret_cast<Box*>((address + alignof(Box) - 1) & ~uintptr_t(alignof(Box) - 1));
  }
};

/// size of a userdata that can hold an aligned box at any address
template <class T>
inline constexpr size_t box_bytes = sizeof(Box<T>) + alignof(Box<T>);

/// Does the value at the index have the class's metatable?
bool has_class(lua_State* L, int index, const Class& kind);

/// The T in the userdata at the index; null if it is something else or was closed.
template <class T>
T* to(lua_State* L, int index) {
  if (!has_class(L, index, class_of<T>())) return nullptr;
  if (lua_rawlen(L, index) != box_bytes<T>) return nullptr;
  auto* box = Box<T>::in(lua_touserdata(L, index));
  return box->kind == &class_of<T>() && box->alive ? box->value() : nullptr;
}

/// Approximate memory that a value owns besides its userdata [bytes]; overloaded next to classes
/// whose values own much. Shared parts are counted by the owner that is certain to drop them last,
/// or with a small size.
template <class T>
size_t owned_bytes(const T&) {
  return 0;
}

/// Destroys the value; a second call, or a foreign self, has no effect.
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

/// Adds to the owned memory of the value at the index, which must be a T [bytes].
template <class T>
void add_owned(lua_State* L, int index, size_t bytes) {
  auto* box = Box<T>::in(lua_touserdata(L, index));
  const auto kilobytes = static_cast<uint32_t>(std::min(bytes >> 10, size_t{1} << 30));
  box->owned_kb += kilobytes;
  if (kilobytes > 0) count_owned(L, kilobytes);
}

/// Pushes a userdata with the value.
/// user_values  number of its associated Lua values, initially nil
/// returns      1
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

/// The object of the running method or field.
template <class T>
T& self(lua_State* L) {
  if (T* object = to<T>(L, 1)) return *object;
  fail_self(L, class_of<T>());
}

}  // namespace clench
