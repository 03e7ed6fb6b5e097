// Worlds from files and to files, as clench.load and world:save.
#pragma once
#include <lua.hpp>

#include "clench/io/mjcf_write/written_scene.h"
#include "clench/io/read/read.h"
#include "clench/script/bind/handles.h"

namespace clench {

/// Loads the world of a file, which may be a script, and pushes it. `path` as find_file gives it.
WorldPtr push_world_of(lua_State* L, const std::filesystem::path& path, const ReadOptions& reading);
struct SavingOptions {
  std::filesystem::path root, confine;  ///< as in WriteOptions
  std::string format = {};              ///< "mjcf", "graspit" or "lua"; empty: by the extension
};
/// Writes it, reads it again, and warns of contents that the file cannot represent.
void save_world(lua_State* L, const World& world, const std::filesystem::path& path,
                const SavingOptions& saving);

/// Writes a scene of MuJoCo, and warns of properties that it cannot represent. The request's world,
/// friction and time step are those of the world.
void save_scene(lua_State* L, const World& world, const std::filesystem::path& path,
                const SavingOptions& saving, SceneRequest& request);
/// The description of a world for a scene, including the gains and limits that scripts give to
/// motors.
WorldSpec scene_spec(const World& world);
/// spec  as scene_spec gives it
SceneRequest scene_of(const World& world, const WorldSpec& spec, const std::filesystem::path& path);
/// Is the world written to this path as a scene of MuJoCo? By default an .xml is one, unless a
/// robot carries another one, as reading would merge the two; `format` overrides this.
/// throws  Error for a format that does not fit the extension
bool is_mjcf_target(const World& world, const std::filesystem::path& path,
                    const std::string& format);

/// (path, options) -> world
int load_world(lua_State* L);
/// (world, path, options)
int save_world(lua_State* L);

}  // namespace clench
