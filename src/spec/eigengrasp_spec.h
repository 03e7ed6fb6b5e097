// Eigengrasps given by a file or a script: a few postures whose linear combinations are the hand's
// postures.
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace clench {

struct EigengraspSpec {
  Eigen::VectorXd vector;   ///< one per DOF, of any length but zero
  double eigenvalue = 0.5;  ///< weight of the principal component; information only
  /// of its amplitude; absent: derived from those of the DOFs
  std::optional<std::array<double, 2>> limits;
};

/// dofs = origin + norm * (sum of amplitude * unit vector), element by element; for hands with
/// `dofs` DOFs.
/// source  Ciocarlie & Allen (2009), Hand posture subspaces for dexterous robotic grasping, sec. 3
struct EigengraspSet {
  int dofs = 0;
  std::vector<EigengraspSpec> grasps;     ///< linearly independent
  std::optional<Eigen::VectorXd> origin;  ///< posture of zero amplitudes; absent: middle of ranges
  std::optional<Eigen::VectorXd> norm;    ///< scale of each DOF, not 0; absent: 1
};

/// One eigengrasp per DOF: amplitudes are DOF values relative to the middle of their ranges.
EigengraspSet identity_eigengrasps(int dofs);

/// Position in a file, "hand.egr:7"; empty: unknown.
struct EigengraspPlaces {
  std::vector<std::string> grasps = {};  ///< one per eigengrasp
  std::string origin = {}, norm = {};
};

/// throws Error with one sentence that begins with the subject if a count does not match,
/// number_rule rejects a number, or positive_rule one that must not be zero, limits are exchanged,
/// there is no eigengrasp, or one is a linear combination of those before it. `places` replace the
/// subject if they are known.
void check_eigengrasps(const EigengraspSet& set, const std::string& subject,
                       const EigengraspPlaces& places = {});

}  // namespace clench
