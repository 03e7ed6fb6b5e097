// Tendons whose length is a weighted sum of DOFs: they couple joints without constraining them
// rigidly.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clench {

/// length = sum of arm * dof. Forces act along the length: the effort on a DOF is its arm times the
/// force. Only simulations use it: DOFs that are set directly may exceed the range.
struct JointTendonSpec {
  std::string name = {};  ///< name in its file; empty: none
  /// DOFs, each once, and how the length changes per unit of each, not 0
  std::vector<std::pair<int, double>> arms = {};
  std::optional<std::array<double, 2>> range = {};  ///< of the length; absent: unlimited
  double stiffness = 0;                             ///< [N or N m per unit of length]
  std::array<double, 2> slack = {0, 0};             ///< lengths between which the spring is slack
  double damping = 0;                               ///< [N or N m per unit of length per second]
  double friction = 0;                              ///< dry, of the length [N or N m]
};

}  // namespace clench
