// Lists of grasps as other programs exchange them: isaac_grasp (NVIDIA Isaac Sim and ROS),
// GraspGen, MultiGripperGrasp. All have the pose of the hand's base in the object's frame [m] and
// DOFs in [rad or m].
#pragma once
#include <filesystem>

#include "clench/io/grasps/grasp_writing.h"
#include "clench/io/text/read_options.h"
#include "clench/io/text/yaml.h"

namespace clench {

/// YAML of one hand and one object: position, orientation {w, xyz}, cspace_position,
/// pregrasp_cspace_position by names of DOFs, and confidence: the note of that name, else epsilon
/// within [0, 1], else 1.
/// throws Error when a grasp has no pose, or hands or objects differ
/// source  Isaac ROS documentation, "Isaac Grasp File", format 1.0
std::string isaac_grasp_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                             const WriteOptions& options);
std::vector<GraspSpec> read_isaac_grasps(const YamlNode& root, const std::string& file,
                                         const ReadOptions& options);

/// JSON of one object: its file and scale, 4 x 4 transforms, and which of them hold it: the note
/// "object_in_gripper", else those with epsilon > 0 that do not collide.
/// source  NVlabs GraspGen, docs/GRASP_DATASET_FORMAT.md, version 1.0.0
std::string graspgen_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                          const WriteOptions& options);
std::vector<GraspSpec> read_graspgen(const YamlNode& root, const std::string& file,
                                     const ReadOptions& options);

/// JSON of one gripper and one object: poses x y z qw qx qy qz, and dofs in the order of
/// "dof_names", a key of our own. Results of tests become notes.
/// source  IRVLUTD isaac_sim_grasping, docs/grasp_data_format.md, and managers.py, which reads
/// "object_id"
std::string multigripper_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                              const WriteOptions& options);
std::vector<GraspSpec> read_multigripper(const YamlNode& root, const std::string& file,
                                         const ReadOptions& options);

}  // namespace clench
