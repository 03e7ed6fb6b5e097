// Strings on the stack.
#pragma once
#include <lua.hpp>
#include <string_view>

namespace clench {

/// The string at the index, including zero bytes, valid while it stays on the stack.
inline std::string_view string_at(lua_State* L, int index) {
  size_t size = 0;
  const char* text = lua_tolstring(L, index, &size);
  return {text, text ? size : 0};
}

}  // namespace clench
