// Inverse kinematics: values of a robot's DOFs that bring one of its bodies to a pose.
#pragma once
#include "clench/base/random.h"
#include "clench/model/find.h"

namespace clench {

/// Matched part of the target's orientation.
enum class IkOrientation {
  full,
  axis,  ///< direction of +z; the turn about it is arbitrary
  none,
};

struct IkOptions {
  /// the frame to be brought to the target, in the body's frame: a tool, an approach frame
  Pose X_BT = {};
  IkOrientation orientation = IkOrientation::full;
  std::vector<int> dofs = {};  ///< DOFs that may move; empty: all
  int starts = 20;             ///< maximum: the first from the present posture, the others random
  uint64_t seed = 0;           ///< of the random starts
  double tolerance = 1e-6;     ///< > 0 [m]
  double angle_tolerance = 1e-6;  ///< > 0 [rad]
  /// accept only postures in which nothing that the robot moves collides
  bool collision_free = false;
};

struct IkResult {
  bool reached = false;  ///< within both tolerances, and free of collision if requested
  /// within their limits: of the first start that reached it, otherwise the nearest
  Eigen::VectorXd dofs;
  double distance = 0;   ///< remaining distance from the target [m]
  double angle = 0;      ///< remaining angle of the matched part [rad]
  int starts = 0;        ///< number of starts used
  int iterations = 0;    ///< of all starts
  int in_collision = 0;  ///< number of starts that reached the target but collided
};

/// Levenberg-Marquardt method within the limits: DOFs that would leave their range stay at its end.
/// A turn by 1 rad is weighted like a displacement of 0.1 m. All joints follow their DOFs. The
/// world is not changed.
/// body     one that the robot's joints move: its own, or one of a robot that it carries
/// throws   Error if no DOF moves the body, or an option is out of range
/// source   Sugihara (2011), Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt
///          method, IEEE T-RO 27
IkResult inverse_kinematics(const World& world, Id<Robot> robot, Id<Body> body, const Pose& X_WT,
                            const IkOptions& options = {}, QueryContext* context = nullptr);

/// Uniformly distributed values within the limits; continuous DOFs are drawn from one turn around
/// their present value.
Eigen::VectorXd random_posture(const World& world, Id<Robot> robot, Random& random);

}  // namespace clench
