// What the writers of lists of grasps share: numbers as text, and what is lost in a format.
#pragma once
#include <string>
#include <vector>

#include "clench/io/text/named_number.h"
#include "clench/io/text/write_options.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// All digits, and seen to be no integer: "0.25", "1.0", "1e-300", "nan".
std::string real_text(double x);
/// [1.0, 0.5]
std::string real_list(const std::vector<double>& numbers);

/// Position, then quaternion w x y z.
std::vector<double> pose_numbers(const Pose& pose);

/// Names of the DOFs, "dof1" where none is known.
std::vector<std::string> dof_names_of(const GraspSpec& grasp);

/// What a format can hold beside poses.
struct Holds {
  bool dofs = false, epsilon = false, pregrasp_dofs = false, notes = false, hand = true,
       object = true, files = false;
  bool joints = false, contacts = false, pregrasp_poses = false, squeeze = false;
};

/// Of the formats that hold all that JSON lines hold.
/// joints  do the values of joints have the same names in all grasps?
inline Holds everything(bool joints) {
  return {.dofs = true,
          .epsilon = true,
          .pregrasp_dofs = true,
          .notes = true,
          .files = true,
          .joints = joints,
          .contacts = true,
          .pregrasp_poses = true,
          .squeeze = true};
}
/// Warns once of what the grasps have and the format does not hold:
/// "g.yaml: the format isaac_grasp does not hold contacts and joint positions, which are not
/// written"
void report_lost(const std::vector<GraspSpec>& grasps, const Holds& holds, const std::string& file,
                 const std::string& format, const WriteOptions& options);

/// DOFs of all grasps, where the file names them once: as many, of the same names and units.
/// throws Error  "g.npz: grasps[2]: expected the DOFs of the first grasp, a, b, got a, c"
void check_same_dofs(const std::vector<GraspSpec>& grasps, const std::string& file);

/// The pose of each grasp; of one hand, or of one object, where the format names but one.
/// throws Error  "g.json: grasps[2]: expected a pose, got none"
void check_writable(const std::vector<GraspSpec>& grasps, const std::string& file, bool one_hand,
                    bool one_object);

}  // namespace clench
