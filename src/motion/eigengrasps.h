// Eigengrasps: a hand's posture by a few amplitudes, and back.
#pragma once
#include "clench/model/robot.h"

namespace clench {

using Range = std::array<double, 2>;  ///< {low, high}

/// A set made ready for one hand: unit vectors, origin within the limits of the DOFs.
/// dofs = o + n * (E^T a)   and   a = P ((dofs - o) / n)   with P = (E E^T)^-1 E, so P E^T = I
/// E has a unit vector a row; * and / go DOF by DOF.
/// source  Ciocarlie & Allen (2009), Hand posture subspaces for dexterous robotic grasping, sec. 3
class Eigengrasps {
 public:
  /// of the robot's own set, or one eigengrasp a DOF when it has none
  explicit Eigengrasps(const Robot& robot);
  /// limits  of the DOFs; empty: unknown, and then an absent origin is zero
  /// throws  Error when check_eigengrasps does, or the counts differ
  Eigengrasps(const EigengraspSet& set, const std::vector<Range>& limits);

  int size() const { return static_cast<int>(vectors_.rows()); }
  int dofs() const { return static_cast<int>(vectors_.cols()); }
  const Eigen::MatrixXd& vectors() const { return vectors_; }  ///< unit, a row each
  const Eigen::VectorXd& eigenvalues() const { return eigenvalues_; }
  const Eigen::VectorXd& origin() const { return origin_; }
  const Eigen::VectorXd& norm() const { return norm_; }

  /// Amplitudes of the posture nearest to `dofs`, distances measured in DOFs divided by the norm.
  /// throws  Error on a wrong count, as the next ones do
  Eigen::VectorXd amplitudes(const Eigen::VectorXd& dofs) const;
  /// Rigid: the posture of the amplitudes and nothing else. It may lie outside the limits.
  Eigen::VectorXd posture(const Eigen::VectorXd& amplitudes) const;
  /// Free: what `from` has besides its own amplitudes is kept.
  Eigen::VectorXd posture(const Eigen::VectorXd& amplitudes, const Eigen::VectorXd& from) const;

  /// How far each amplitude can go while the others stay: the set's own limits; else as far as no
  /// DOF of `dofs` that is moved leaves its range. Always holds the amplitude that it has now.
  /// A DOF of which a unit vector has less than 1e-9 counts as not moved.
  std::vector<Range> limits(const Eigen::VectorXd& dofs) const;
  /// What each amplitude can be at all: the set's own limits; else the least and largest of all
  /// postures within the limits of the DOFs.
  std::vector<Range> range() const;

 private:
  Eigen::MatrixXd vectors_, projection_;  // E, P
  Eigen::VectorXd eigenvalues_, origin_, norm_;
  std::vector<std::optional<Range>> own_limits_;
  std::vector<Range> dof_limits_;
};

/// Principal components of postures, of the same number of DOFs each: eigenvectors of their
/// covariance (divided by the number of postures less one), of the largest eigenvalues first, and
/// their mean as the origin. Of each vector the entry of largest size, the first of equals, is
/// positive.
/// count   of eigengrasps; 0: all that the postures vary in
/// throws  Error when there are fewer than two postures, one has another length or a number that is
///         not finite, or they do not vary in as many directions
EigengraspSet principal_eigengrasps(const std::vector<Eigen::VectorXd>& postures, int count = 0);

}  // namespace clench
