// An MJCF model in memory, and the robots built from its joint trees.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clench/io/mjcf/bodies/mjcf_contacts.h"
#include "clench/io/mjcf/bodies/mjcf_tree.h"
#include "clench/io/mjcf/geoms/mjcf_materials.h"
#include "clench/io/mjcf/joints/mjcf_couplings.h"

namespace clench {

/// A tree as a robot, with data for the reader of the scene.
struct MjcfRobot {
  RobotSpec robot;
  MjcfTree tree;  ///< its model holds only the remaining joints after couplings, no links
  std::map<std::string, int> parts;  ///< links of the robot by names of bodies; -1: the base
  MjcfMaterials materials;           ///< of the links for which the file gives friction
};

class MjcfModel {
 public:
  /// whole  the kind of result, for messages: "robot" or "world"
  MjcfModel(const std::filesystem::path& path, FileCache& cache, const char* whole);

  const Worldbody& worldbody() const { return worldbody_; }
  MjcfDocument& document() { return document_; }
  MjcfGeoms& geoms() { return geoms_; }
  MjcfContacts& contacts() { return contacts_; }
  /// name in the file, otherwise the file's stem
  const std::string& name() const { return name_; }
  const MjcfNames& names() const { return names_; }  ///< of all elements
  /// Bodies directly in the world that have joints, or descendants with joints.
  std::vector<const TopBody*> joint_trees() const;
  /// A tree as a separate robot: its root body is the base if it has no joint; otherwise the base
  /// is an added frame.
  MjcfTree read_tree(const TopBody& body);
  /// Scales masses to the compiler's `settotalmass`.
  void scale_masses(MjcfTree& tree);
  /// The tree that begins with a body, as one of the robots of a scene.
  MjcfRobot scene_robot(const TopBody& body, bool first);
  /// trunk       root body of the robot, one of several; null: it is the only robot
  /// tells       also reports elements that concern no joint
  /// fixed_base  true if its first body is fixed to the world
  MjcfRobot make(MjcfTree tree, const std::string& robot_name, const TopBody* trunk, bool tells,
                 bool fixed_base);
  /// Reports the remaining diagnostics of the complete file.
  void tell();

 private:
  void leave_out(const MjcfNode& section);
  void warn_of_starts(const TreeModel& tree) const;
  void read_excludes(MjcfTree& tree);
  void set_materials(MjcfTree& tree, MjcfMaterials& materials) const;

  FileCache& cache_;
  const char* whole_;
  MjcfDocument document_;
  MjcfGeoms geoms_;
  MjcfContacts contacts_;
  Worldbody worldbody_;
  std::string name_;
  MjcfNames names_;
  MjcfFileJoints file_joints_;
  std::optional<double> mass_scale_;  // computed when first needed
};

}  // namespace clench
