// The Lua standard library, packed into the binary: chunks of stdlib/ by module name.
#pragma once
#include <lua.hpp>
#include <span>
#include <string_view>

namespace clench {

struct PackedFile {
  std::string_view path;  ///< "shapes/box.lua"
  std::string_view text;
};

/// Every file of stdlib/, sorted by path.
std::span<const PackedFile> packed_files();

/// The file of a module "shapes.box": shapes/box.lua or shapes/box/init.lua;
/// null when there is none.
const PackedFile* find_packed(std::string_view module);

/// Leaves the module's value on the stack: run at the first call, shared with require
/// "clench.<module>". Raises Lua errors, so no C++ object may be alive.
void push_packed(lua_State* L, const char* module);

/// Adds a last searcher to package.searchers: require "clench.<module>", and "<module>" too if bare
/// names are wanted.
void add_packed_searcher(lua_State* L, bool bare_names);

}  // namespace clench
