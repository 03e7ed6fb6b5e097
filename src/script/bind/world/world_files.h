// Worlds from files and to files, as clench.load and world:save.
#pragma once
#include <lua.hpp>

#include "clench/io/read.h"
#include "clench/script/bind/handles.h"

namespace clench {

/// The world in a file, a script or not, left on the stack. `path` as find_file gives it.
WorldPtr push_world_of(lua_State* L, const std::filesystem::path& path, const ReadOptions& reading);
struct SavingOptions {
  std::filesystem::path root, confine;  ///< as in WriteOptions
};
/// Writes it, reads it again, and warns of what the file does not hold.
void save_world(lua_State* L, const World& world, const std::filesystem::path& path,
                const SavingOptions& saving);

/// (path, options) -> world
int load_world(lua_State* L);
/// (world, path, options)
int save_world(lua_State* L);

}  // namespace clench
