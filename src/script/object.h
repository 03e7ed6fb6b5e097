// C++ values as Lua userdata: made by push_object, read by to, check_object (check.h) and self.
#pragma once
#include <cstdint>
#include <lua.hpp>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "script/entry.h"

namespace clench {

/// The Class that stands for T; specialised beside each class's declaration.
template <class T>
const Class& class_of();

/// How a value lies in its userdata: aligned by hand, because Lua aligns to 8 bytes only.
template <class T>
struct Box {
  const Class* kind;
  bool alive;  ///< false after __gc or __close
  alignas(T) unsigned char storage[sizeof(T)];

  T* value() { return std::launder(reinterpret_cast<T*>(storage)); }

  static constexpr size_t bytes = sizeof(kind) + sizeof(T) + 2 * alignof(T) + 2 * alignof(void*);
  static Box* in(void* block) {
    const auto address = reinterpret_cast<uintptr_t>(block);
    return reinterpret_cast<Box*>((address + alignof(Box) - 1) & ~uintptr_t(alignof(Box) - 1));
  }
};

/// Does the value at the index have the class's metatable?
bool has_class(lua_State* L, int index, const Class& kind);

/// The T in the userdata at the index; null when it is something else or was closed.
template <class T>
T* to(lua_State* L, int index) {
  if (!has_class(L, index, class_of<T>())) return nullptr;
  if (lua_rawlen(L, index) != Box<T>::bytes) return nullptr;
  auto* box = Box<T>::in(lua_touserdata(L, index));
  return box->kind == &class_of<T>() && box->alive ? box->value() : nullptr;
}

/// Ends the value's life; a second call, or a foreign self, does nothing.
template <class T>
int close_object(lua_State* L) {
  if (T* value = to<T>(L, 1)) {
    Box<T>::in(lua_touserdata(L, 1))->alive = false;
    value->~T();
  }
  return 0;
}

/// Leaves a userdata with the value on the stack.
/// returns  1
template <class T>
int push_object(lua_State* L, T value) {
  static_assert(sizeof(Box<T>) + alignof(Box<T>) <= Box<T>::bytes);
  const Class& kind = class_of<T>();
  auto* box = Box<T>::in(lua_newuserdatauv(L, Box<T>::bytes, 0));
  box->kind = &kind;
  box->alive = false;  // until the value is in it
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
  return 1;
}

/// throws  Error "hand:autograsp: wanted a robot before the colon, got a table;
///         use hand:autograsp(...)"
[[noreturn]] void fail_self(lua_State* L, const Class& kind);

/// The object that a method or field belongs to.
template <class T>
T& self(lua_State* L) {
  if (T* object = to<T>(L, 1)) return *object;
  fail_self(L, class_of<T>());
}

}  // namespace clench
