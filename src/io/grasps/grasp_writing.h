// Functions shared by the writers of lists of grasps: numbers as text, and reports of losses.
#pragma once
#include <string>
#include <vector>

#include "clench/io/text/named_number.h"
#include "clench/io/text/write_options.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// All digits, in a form that is not read as an integer: "0.25", "1.0", "1e-300", "nan".
std::string real_text(double x);
/// [1.0, 0.5]
std::string real_list(const std::vector<double>& numbers);

/// Position, then quaternion w x y z.
std::vector<double> pose_numbers(const Pose& pose);

/// Names of the DOFs, "dof1" and so on if they have none.
std::vector<std::string> dof_names_of(const GraspSpec& grasp);

/// Parts that a format can hold in addition to poses.
struct Holds {
  bool dofs = false, epsilon = false, pregrasp_dofs = false, notes = false, hand = true,
       object = true, files = false;
  bool joints = false, contacts = false, pregrasp_poses = false, squeeze = false;
};

/// For formats that hold everything that JSON lines hold.
/// joints  true if joint values have the same names in all grasps
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
/// Warns once of parts that the grasps have and the format does not hold:
/// "g.yaml: the format isaac_grasp does not hold contacts and joint positions, which are not
/// written"
void report_lost(const std::vector<GraspSpec>& grasps, const Holds& holds, const std::string& file,
                 const std::string& format, const WriteOptions& options);

/// For files that name the DOFs once: all grasps must have the same number of DOFs, names and
/// units.
/// throws Error  "g.npz: grasps[2]: expected the DOFs of the first grasp, a, b, got a, c"
void check_same_dofs(const std::vector<GraspSpec>& grasps, const std::string& file);

/// Each grasp must have a pose; if the format names only one hand or object, all must have the
/// same.
/// throws Error  "g.json: grasps[2]: expected a pose, got none"
void check_writable(const std::vector<GraspSpec>& grasps, const std::string& file, bool one_hand,
                    bool one_object);

}  // namespace clench
