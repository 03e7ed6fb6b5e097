// Writes worlds as MJCF scenes: the scene file, and its meshes next to it.
#pragma once
#include "clench/io/mjcf_write/written_scene.h"
#include "clench/io/write/write_world.h"

namespace clench {

/// Writes SCENE.xml and the meshes SCENE_files/BODY.obj: all or none. Warns of properties that the
/// scene does not hold.
/// throws  Error if a file cannot be written; older files are kept then
void write_mjcf(const SceneRequest& request, const std::filesystem::path& path,
                const WriteOptions& options = {});

}  // namespace clench
