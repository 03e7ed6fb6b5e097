// Couplings of joints in an MJCF model, to each other and to motors: equalities, fixed tendons and
// actuators.
#pragma once
#include <map>
#include <string>

#include "clench/io/mjcf/document/mjcf_document.h"
#include "clench/io/tree/tree_model.h"

namespace clench {

/// Joints of a file, by name.
struct MjcfFileJoints {
  std::map<std::string, bool> is_free;
  bool composes = false;                ///< true if there are elements that would generate joints
  std::map<std::string, int> in_trees;  ///< number of joint trees that contain the name

  /// Adds an element of the world and its descendants to `is_free` and `composes`.
  void add(const MjcfNode& node);
};

/// Counts the named joints below an element, except <freejoint>.
void count_joint_names(const MjcfNode& node, std::map<std::string, int>& into);

/// Lets joints that must move together follow one of them, applies the limits and forces of
/// actuators, and marks joints that no actuator drives as passive if there are actuators. Warns of
/// couplings that cannot be represented.
/// trunk  root body of the robot, one of several; null: the robot is the only one
/// tells  also warns of elements that concern no joint
void read_mjcf_couplings(MjcfDocument& document, FileCache& cache, TreeModel& tree,
                         const MjcfFileJoints& joints, const MjcfNode* trunk, bool tells);

}  // namespace clench
