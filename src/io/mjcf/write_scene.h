// A world as an MJCF scene, for MuJoCo 2.2 and later.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "clench/io/mjcf/written_scene.h"

namespace clench {

struct MjcfFiles {
  std::string text;                          ///< of the scene itself
  std::map<std::string, std::string> files;  ///< meshes: their text by their name
  std::vector<std::string> losses;           ///< what the scene does not hold, or holds otherwise
};

/// Bodies with inertias, joints with limits, springs and friction, couplings, tendons, actuators, friction of
/// pairs, and the keys of the request. The reference posture of the scene is that of the world now,
/// and coordinates of joints are those of the robots' own files.
/// folder  of the meshes, from the scene's own folder on: "scene_files/"
/// source  MuJoCo documentation, "XML Reference"
MjcfFiles mjcf_scene(const SceneRequest& request, const std::string& folder);

/// The state of the world now, as a key.
SceneKey present_key(const WorldSpec& world, const std::string& name);
/// A keyframe of the world, whose other bodies stand as they do now.
SceneKey key_of(const WorldSpec& world, const KeyframeSpec& keyframe);

/// Positions that all joints have where they follow their DOFs [rad or m].
std::vector<double> joints_at(const RobotSpec& robot, const std::vector<double>& dofs);

}  // namespace clench
