// Eigengrasps: converts between a hand's posture and a few amplitudes.
#pragma once
#include "clench/model/robot.h"

namespace clench {

using Range = std::array<double, 2>;  ///< {low, high}

/// A set prepared for one hand: unit vectors, origin within the limits of the DOFs.
/// dofs = o + n * (E^T a)   and   a = P ((dofs - o) / n)   with P = (E E^T)^-1 E, so P E^T = I
/// E has one unit vector per row; * and / are elementwise.
/// source  Ciocarlie & Allen (2009), Hand posture subspaces for dexterous robotic grasping, sec. 3
class Eigengrasps {
 public:
  /// of the robot's set, or one eigengrasp per DOF if it has none
  explicit Eigengrasps(const Robot& robot);
  /// limits  of the DOFs; empty: unknown, and an absent origin is zero
  /// throws  Error if check_eigengrasps does, or if the counts differ
  Eigengrasps(const EigengraspSet& set, const std::vector<Range>& limits);

  int size() const { return static_cast<int>(vectors_.rows()); }
  int dofs() const { return static_cast<int>(vectors_.cols()); }
  const Eigen::MatrixXd& vectors() const { return vectors_; }  ///< unit, one per row
  const Eigen::VectorXd& eigenvalues() const { return eigenvalues_; }
  const Eigen::VectorXd& origin() const { return origin_; }
  const Eigen::VectorXd& norm() const { return norm_; }

  /// Amplitudes of the posture nearest to `dofs`, with distances measured in DOFs divided by the
  /// norm.
  /// throws  Error if the count is wrong, as the following functions do
  Eigen::VectorXd amplitudes(const Eigen::VectorXd& dofs) const;
  /// Rigid: the posture given by the amplitudes alone. It may lie outside the limits.
  Eigen::VectorXd posture(const Eigen::VectorXd& amplitudes) const;
  /// Free: changes the amplitudes of `from`, and keeps its component outside their span.
  Eigen::VectorXd posture(const Eigen::VectorXd& amplitudes, const Eigen::VectorXd& from) const;

  /// Range of each amplitude while the others are constant: the set's own limits; otherwise the
  /// range in which no moved DOF of `dofs` leaves its limits. Always includes the present
  /// amplitude. A DOF with a component below 1e-9 in the unit vector counts as not moved.
  std::vector<Range> limits(const Eigen::VectorXd& dofs) const;
  /// Overall range of each amplitude: the set's own limits; otherwise minimum and maximum over all
  /// postures within the limits of the DOFs.
  std::vector<Range> range() const;

 private:
  Eigen::MatrixXd vectors_, projection_;  // E, P
  Eigen::VectorXd eigenvalues_, origin_, norm_;
  std::vector<std::optional<Range>> own_limits_;
  std::vector<Range> dof_limits_;
};

/// Principal components of postures with equal numbers of DOFs: eigenvectors of their covariance
/// (divided by the number of postures minus one), in descending order of eigenvalues, with the mean
/// posture as the origin. The largest entry of each vector, the first of equals, is positive.
/// count   number of eigengrasps; 0: all directions in which the postures vary
/// throws  Error if there are fewer than two postures, if one has another length or a number that
///         is not finite, or if they vary in fewer directions
EigengraspSet principal_eigengrasps(const std::vector<Eigen::VectorXd>& postures, int count = 0);

}  // namespace clench
