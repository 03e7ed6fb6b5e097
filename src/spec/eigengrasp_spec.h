// Eigengrasps as a file or a script gives them: a few postures whose sums are the hand's.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace clench {

struct EigengraspSpec {
  Eigen::VectorXd vector;                       ///< one per DOF, of any length but zero
  double eigenvalue = 0.5;                      ///< weight of the principal component; told only
  std::optional<std::array<double, 2>> limits;  ///< of its amplitude; absent: from the DOFs'
};

/// dofs = origin + norm * (sum of amplitude * unit vector), DOF by DOF; for hands of `dofs` DOFs.
/// source  Ciocarlie & Allen (2009), Hand posture subspaces for dexterous robotic grasping, sec. 3
struct EigengraspSet {
  int dofs = 0;
  std::vector<EigengraspSpec> grasps;     ///< linearly independent
  std::optional<Eigen::VectorXd> origin;  ///< posture of zero amplitudes; absent: middle of ranges
  std::optional<Eigen::VectorXd> norm;    ///< scale of each DOF, not 0; absent: 1
};

/// An eigengrasp for each DOF: amplitudes are DOFs, counted from the middle of their ranges.
EigengraspSet identity_eigengrasps(int dofs);

/// Where a file says what, "hand.egr:7"; empty: it is not known.
struct EigengraspPlaces {
  std::vector<std::string> grasps = {};  ///< one per eigengrasp
  std::string origin = {}, norm = {};
};

/// throws Error with one sentence, begun by the subject, when a count does not match, number_rule
/// refuses a number, or positive_rule one where zero is refused, limits are exchanged, there is no
/// eigengrasp, or one is a sum of those before it. `places` stand for the subject where they are
/// known.
void check_eigengrasps(const EigengraspSet& set, const std::string& subject,
                       const EigengraspPlaces& places = {});

}  // namespace clench
