// Keyframes of an MJCF scene: converts rows of numbers to poses of bodies and values of DOFs.
#pragma once
#include "clench/io/mjcf/mjcf_model.h"
#include "clench/spec/world_spec.h"

namespace clench {

/// A body directly in the world, and the bodies and robot created from it.
struct SceneBody {
  struct Part {
    int body = 0;  ///< index into WorldSpec::bodies
    Pose X_SB;     ///< in the scene's body
  };
  Pose X_WB;  ///< as placed by the file
  bool free = false, mocap = false;
  int robot = -1;                            ///< index into WorldSpec::robots
  std::vector<Part> bodies;                  ///< of objects and obstacles
  std::vector<std::vector<QposSlot>> slots;  ///< of a robot: of each link's joints
  std::vector<TreeJoint> joints;             ///< of a robot; leaders are its DOFs, in their order
};

/// lossy  true if qpos contains numbers of bodies that are not read
/// throws Error  "scene.xml:31: key: qpos: expected 9 numbers, got 8"
void read_mjcf_keyframes(MjcfDocument& document, const std::vector<SceneBody>& bodies, bool lossy,
                         const FileCache& cache, WorldSpec& world);

}  // namespace clench
