// Values of a hand's DOFs and joints in a grasp: by name, or in an order.
#pragma once
#include "clench/base/diagnostic.h"
#include "clench/model/world.h"
#include "clench/spec/grasp_spec.h"

namespace clench {

/// Order of DOFs in a grasp without names.
enum class DofOrder {
  unknown,  ///< as `hand`, with a warning if Isaac Sim's order differs
  hand,     ///< that of the hand's own DOFs, or joints
  isaac     ///< breadth first: the first joints of all fingers, then the second ones
};

struct GraspDofOptions {
  DofOrder order = DofOrder::unknown;
  Diagnostics diagnostics = {};  ///< receives each value that is changed or ignored
};

/// Posture of a hand: values of all its DOFs, and joints that deviate from their DOF's value.
struct GraspPosture {
  Eigen::VectorXd dofs;            ///< within the limits [rad or m]
  std::vector<JointPosition> own;  ///< empty: all joints follow their DOFs
};

/// Joints of a robot, breadth first from the base, the children of a link in the order of links.
/// Links without a joint count as parts of their parents.
/// source  PhysX articulations number their links in this order, and Isaac Sim their DOFs
std::vector<int> breadth_first_joints(const Robot& robot);

/// Names of the DOFs, or of the joints if `count` is their number, in that order.
/// throws  Error when the hand has another number of both, or joints without names
std::vector<std::string> listed_dof_names(const Robot& robot, size_t count, DofOrder order);

/// Posture of the hand in a grasp. A name is that of a DOF or of one of its joints; DOFs that are
/// not named keep the hand's values. Without names there is a value for each DOF, or for each
/// joint.
///
/// Joints that a DOF moves together may be listed in addition to it: those that differ from the
/// DOF's value cause a warning, and the DOF's value is used. A value that exceeds a limit slightly
/// is set to the limit (see near_limits).
/// throws  Error if the hand has other DOFs or joints, a unit differs, or a value lies far outside
///         its limits
GraspPosture grasp_posture(const World& world, Id<Robot> hand, const GraspSpec& grasp,
                           const Place& place, const GraspDofOptions& options = {});

/// DOFs of the pregrasp, all in the hand's order; those that the pregrasp does not name are as in
/// `posture`.
/// throws as grasp_posture
Eigen::VectorXd pregrasp_dofs(const World& world, Id<Robot> hand, const GraspSpec& grasp,
                              const GraspPosture& posture, const Place& place,
                              const GraspDofOptions& options = {});

/// The apply_grasp of grasp.h, with an order of DOFs and warnings.
void apply_grasp(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object,
                 const GraspDofOptions& options);

}  // namespace clench
