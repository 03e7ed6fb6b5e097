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

/// The file of a module "shapes.box": shapes/box.lua or shapes/box/init.lua; null if there is none.
const PackedFile* find_packed(std::string_view module);

/// Pushes the module's value: run at the first call, shared with require "clench.<module>". Raises
/// Lua errors, so no C++ object may be alive.
void push_packed(lua_State* L, const char* module);

/// Replaces the name at index 1 by that function of a module. Raises Lua errors, too.
void take_packed_function(lua_State* L, const char* module);

/// Makes require load "clench" and "clench.<module>" from here, before it searches elsewhere and
/// independent of existing files.
/// module  index of the value of "clench"
void add_packed_searcher(lua_State* L, int module);
/// Makes require load the modules that scripts use by their bare names, such as "test", from here
/// too.
void add_bare_names(lua_State* L);
/// Inserts the searcher on top of the stack into those of require, as number `place`; pops it.
void insert_searcher(lua_State* L, int place);
/// Number of searchers that these two insert before Lua's own.
int count_packed_searchers(lua_State* L, int searchers);

}  // namespace clench
