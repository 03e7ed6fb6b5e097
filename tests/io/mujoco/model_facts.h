// Facts about a model of rigid bodies on which two readers of its file must agree, in the world
// frame at the reference posture.
#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "clench/math/pose.h"

namespace clench::test {

/// A body, or a group of bodies that one reader merges.
struct BodyFacts {
  std::string name;
  Pose X_WB;
  double mass = 0;                                      ///< [kg]
  Eigen::Vector3d com_W = Eigen::Vector3d::Zero();      ///< center of mass [m]
  Eigen::Matrix3d inertia_W = Eigen::Matrix3d::Zero();  ///< about com_W [kg m^2]
  std::optional<std::vector<std::string>> merged = {};  ///< names of the bodies that it represents
  bool weighed = true;                                  ///< false: mass and inertia have no effect
  std::optional<std::string> parent = {};               ///< absent: not compared
};

struct JointFacts {
  enum class Kind { hinge, slide, ball, free };
  std::string name, body;
  Kind kind = Kind::hinge;
  Eigen::Vector3d axis_W = Eigen::Vector3d::Zero(), anchor_W = Eigen::Vector3d::Zero();
  std::optional<std::array<double, 2>> range = {};  ///< absent: no limits [rad or m]
  bool range_compared = true;                       ///< false: actuators or equalities narrow it
  double ref = 0;  ///< coordinate at the reference posture [rad or m]
  double damping = 0, friction = 0, armature = 0, stiffness = 0;  ///< SI units
  double rest = 0;  ///< coordinate at which the spring is slack [rad or m]
};

struct ModelFacts {
  std::string error;              ///< why the file is rejected; empty: it is read
  std::vector<BodyFacts> bodies;  ///< without the world, depth first in the file's order
  std::vector<JointFacts> joints;

  const BodyFacts* body(const std::string& name) const;
  const JointFacts* joint(const std::string& name) const;
};

/// Mass, center of mass and inertia of several bodies together.
BodyFacts merge(const std::vector<BodyFacts>& parts);

/// Messages about all differences between our facts and theirs.
/// tolerance  relative to the size of the model and of each quantity
std::vector<std::string> differences(const ModelFacts& ours, const ModelFacts& theirs,
                                     double tolerance);

}  // namespace clench::test
