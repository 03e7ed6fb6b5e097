// Writes a world as an MJCF scene, for MuJoCo 2.2 and later.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "clench/io/mjcf_write/written_scene.h"

namespace clench {

struct MjcfFiles {
  std::string text;                          ///< of the scene itself
  std::map<std::string, std::string> files;  ///< meshes: texts by name
  std::vector<std::string> losses;           ///< properties that the scene lacks or changes
};

/// Bodies with inertias, joints with limits, springs and friction, couplings, tendons, actuators,
/// friction of pairs, and the keys of the request. The reference posture of the scene is the
/// current posture of the world; coordinates of joints are those in the files of the robots.
/// folder  of the meshes, relative to the folder of the scene: "scene_files/"
/// source  MuJoCo documentation, "XML Reference"
MjcfFiles mjcf_scene(const SceneRequest& request, const std::string& folder);

}  // namespace clench
