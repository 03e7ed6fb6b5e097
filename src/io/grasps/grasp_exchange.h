// Lists of grasps in formats of other programs: isaac_grasp (NVIDIA Isaac Sim and ROS), GraspGen,
// MultiGripperGrasp. All contain the pose of the hand's base in the object's frame [m] and DOFs in
// [rad or m].
#pragma once
#include "clench/io/grasps/grasp_writing.h"
#include "clench/io/text/grasp_sink.h"
#include "clench/io/text/read_options.h"
#include "clench/io/text/yaml.h"

namespace clench {

/// YAML for one hand and one object: position, orientation {w, xyz}, cspace_position,
/// pregrasp_cspace_position by names of DOFs, and confidence: the note of that name, otherwise
/// epsilon clamped to [0, 1], otherwise 1. Grasps are named by their labels "name". The names of
/// the frames in Isaac Sim's Grasp Editor, object_frame_link and gripper_frame_link, are read, too,
/// and so are the files and the scale of GraspDataGen.
/// throws Error if a grasp has no pose, or DOFs without names, or hands or objects differ
/// source  Isaac ROS documentation, "Isaac Grasp File", format 1.0; Isaac Sim documentation, "Grasp
///         Editor"; NVlabs GraspDataGen
std::string isaac_grasp_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                             const WriteOptions& options);
void read_isaac_grasps(const ValueTree& tree, const std::string& file, GraspCollector& list,
                       const ReadOptions& options);

/// JSON for one object: its file and scale, 4 x 4 transforms, and for each whether it holds the
/// object: the note "object_in_gripper", otherwise true if epsilon > 0 and the grasp does not
/// collide.
/// source  NVlabs GraspGen, docs/GRASP_DATASET_FORMAT.md, version 1.0.0
std::string graspgen_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                          const WriteOptions& options);
void read_graspgen(const ValueTree& tree, const std::string& file, GraspCollector& list,
                   const ReadOptions& options);

/// JSON for one gripper and one object: poses x y z qw qx qy qz, and dofs in the order of
/// "dof_names", a key added by Clench; without it the DOFs have no names. Results of tests become
/// notes.
/// source  IRVLUTD isaac_sim_grasping, docs/grasp_data_format.md, and managers.py, which reads
///         "object_id"
std::string multigripper_text(const std::vector<GraspSpec>& grasps, const std::string& file,
                              const WriteOptions& options);
void read_multigripper(const ValueTree& tree, const std::string& file, GraspCollector& list,
                       const ReadOptions& options);

}  // namespace clench
