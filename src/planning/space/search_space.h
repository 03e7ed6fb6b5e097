// Search spaces of grasps: a few variables that say where a hand stands about a reference, and in
// which posture.
// source  Ciocarlie & Allen (2009), Hand posture subspaces for dexterous robotic grasping; spaces
//         as GraspIt! has them
#pragma once
#include "clench/model/robot.h"
#include "clench/motion/eigengrasps.h"
#include "clench/planning/space/variable.h"

namespace clench {

/// How variables say where the hand's base stands; R is the reference, A the approach frame in the
/// base.
enum class PositionKind {
  complete,    ///< Tx Ty Tz, Qw Qx Qy Qz: X_RH = T(t) R(q), q brought to unit length
  axis_angle,  ///< Tx Ty Tz, theta phi alpha: X_RH = T(t) R(alpha about (theta, phi)) X_HA^-1
  ellipsoid,   ///< beta gamma tau dist: on an ellipsoid about R, looking in, rolled by tau
  approach,    ///< dist, wrist_1 wrist_2: along the approach direction from the start, tilted
  fixed,       ///< it stays where it is
};
enum class PostureKind {
  eigengrasps,  ///< "EG 0" and on: amplitudes
  dofs,         ///< the names of the DOFs
  fixed,        ///< it stays as it is
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

/// A value: variables, and what they mean for one hand.
class SearchSpace {
 public:
  /// start  where the hand is: what is fixed stays there, and the approach goes from there
  SearchSpace(const Robot& hand, const HandState& start, const SpaceOptions& options = {});

  /// Those of the posture first. Scripts set ranges, jumps, targets; names and number stay.
  std::vector<Variable>& variables() { return variables_; }
  const std::vector<Variable>& variables() const { return variables_; }
  const SpaceOptions& options() const { return options_; }
  /// A variable of the user's own, which moves nothing: energies read it.
  void add_variable(Variable variable);
  /// throws  Error as check_variable, or when a name comes twice
  void check() const;

  Values start() const;  ///< value of each variable
  /// values  one per variable; those outside are brought inside, as are DOFs that they lead outside
  HandState state(const Values& values) const;
  /// The values whose state is nearest, those of the user's own variables as they start: a pose
  /// that the space does not hold (off the ellipsoid's normals, tilted otherwise than two wrists
  /// can) comes as near as it can.
  Values values(const HandState& state) const;

  /// How different two states are: the largest of the distance of the approach frames' origins by
  /// the radius, half the rotation by pi, and, where it counts, the largest difference of a DOF by
  /// its range.
  double distance(const HandState& a, const HandState& b, double radius, bool posture) const;
  /// Is that below a limit? Found sooner.
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
