// An MJCF model in memory, and the robots that its trees of joints are.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clench/io/mjcf/mjcf_contacts.h"
#include "clench/io/mjcf/mjcf_couplings.h"
#include "clench/io/mjcf/mjcf_materials.h"
#include "clench/io/mjcf/mjcf_tree.h"

namespace clench {

/// A tree as a robot, with what others need to know of it.
struct MjcfRobot {
  RobotSpec robot;
  MjcfTree tree;  ///< its model is what remains: joints after couplings, no links
  std::map<std::string, int> parts;  ///< links of the robot by the names of bodies; -1: the base
  MjcfMaterials materials;           ///< of the links for which the file gives friction
};

class MjcfModel {
 public:
  /// whole  what is read: "robot" or "world"
  MjcfModel(const std::filesystem::path& path, FileCache& cache, const char* whole);

  const Worldbody& worldbody() const { return worldbody_; }
  MjcfDocument& document() { return document_; }
  MjcfGeoms& geoms() { return geoms_; }
  MjcfContacts& contacts() { return contacts_; }
  const std::string& name() const { return name_; }  ///< its own, else the file's stem
  const MjcfNames& names() const { return names_; }  ///< of all elements
  /// Bodies directly in the world that have joints, or carry some that do.
  std::vector<const TopBody*> joint_trees() const;
  /// A tree alone: as a base of its own where it has no joint itself, else below a frame.
  MjcfTree read_tree(const TopBody& body);
  /// Scales masses to the compiler's `settotalmass`.
  void scale_masses(MjcfTree& tree);
  /// The tree that begins with a body, as one of the robots of a scene.
  MjcfRobot scene_robot(const TopBody& body, bool first);
  /// trunk       the body that the robot begins with, one of several; null: it is the only robot
  /// tells       also reports elements that concern no joint
  /// fixed_base  is its first body fixed to the world?
  MjcfRobot make(MjcfTree tree, const std::string& robot_name, const TopBody* trunk, bool tells,
                 bool fixed_base);
  /// Tells what is left to tell of the whole file.
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
