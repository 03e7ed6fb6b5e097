// Search spaces of grasps: a few variables that determine the pose of a hand relative to a
// reference, and its posture.
// source  Ciocarlie & Allen (2009), Hand posture subspaces for dexterous robotic grasping; spaces
//         as in GraspIt!
#pragma once
#include "clench/model/robot.h"
#include "clench/motion/eigengrasps.h"
#include "clench/planning/space/variable.h"

namespace clench {

/// Parametrization of the hand's base; R is the reference, A the approach frame in the base.
enum class PositionKind {
  complete,    ///< Tx Ty Tz, Qw Qx Qy Qz: X_RH = T(t) R(q), with q normalized
  axis_angle,  ///< Tx Ty Tz, theta phi alpha: X_RH = T(t) R(alpha about (theta, phi)) X_HA^-1
  ellipsoid,   ///< beta gamma tau dist: on an ellipsoid about R, facing inwards, rolled by tau
  approach,    ///< dist, wrist_1 wrist_2: along the approach direction from the start, tilted
  fixed,       ///< fixed
};
enum class PostureKind {
  eigengrasps,  ///< "EG 0" and so on: amplitudes
  dofs,         ///< the names of the DOFs
  fixed,        ///< fixed
};

struct SpaceOptions {
  PositionKind position = PositionKind::axis_angle;
  PostureKind posture = PostureKind::eigengrasps;
  Eigen::Vector3d semi_axes = {0.08, 0.08, 0.16};  ///< of the ellipsoid, > 0 [m]
};

/// A hand's pose in the reference, and its DOFs within their limits.
struct HandState {
  Pose X_RH;
  Eigen::VectorXd dofs;
};

/// Variables, and their meaning for one hand.
class SearchSpace {
 public:
  /// start  pose of the hand: its fixed components keep these values, and the approach starts there
  SearchSpace(const Robot& hand, const HandState& start, const SpaceOptions& options = {});

  /// Those of the posture first. Scripts set ranges, jumps and targets; names and number are fixed.
  std::vector<Variable>& variables() { return variables_; }
  const std::vector<Variable>& variables() const { return variables_; }
  const SpaceOptions& options() const { return options_; }
  /// A user-defined variable, which moves nothing: energies read it.
  void add_variable(Variable variable);
  /// throws  Error as check_variable, or if a name is repeated
  void check() const;

  Values start() const;  ///< value of each variable
  /// values  one per variable; those outside their range are moved into it, as are DOFs that they
  ///         lead outside
  HandState state(const Values& values) const;
  /// The values whose state is nearest, with user-defined variables at their start: a pose that the
  /// space does not contain (off the ellipsoid's normals, tilted in a way that two wrist angles
  /// cannot represent) is approximated.
  Values values(const HandState& state) const;

  /// Dissimilarity of two states: the maximum of the distance of the approach frames' origins
  /// divided by the radius, half the rotation angle divided by pi, and, if it is included, the
  /// largest difference of a DOF divided by its range.
  double distance(const HandState& a, const HandState& b, double radius, bool posture) const;
  /// Is distance() below a limit? Faster than computing it.
  bool alike(const HandState& a, const HandState& b, double radius, bool posture,
             double limit) const;

 private:
  double posture_distance(const HandState& a, const HandState& b) const;
  void add_position();
  void add_posture();
  Pose position(const Values& values) const;
  void find_position(const Pose& X_RH, Values& out) const;

  SpaceOptions options_;
  HandState start_;
  Pose X_HA_;
  Eigengrasps eigengrasps_;
  std::vector<Range> limits_;
  std::vector<std::string> dof_names_;
  std::vector<Variable> variables_;
  int position_begin_ = 0, own_begin_ = 0;
};

}  // namespace clench
