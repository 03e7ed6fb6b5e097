// Inverse kinematics: values of a robot's DOFs that bring one of its bodies to a pose.
#pragma once
#include "clench/base/random.h"
#include "clench/model/find.h"

namespace clench {

/// What of the target's orientation counts.
enum class IkOrientation {
  full,
  axis,  ///< where +z points; any turn about it will do
  none,
};

struct IkOptions {
  /// what is to come to the target, in the body's frame: a tool, an approach frame
  Pose X_BT = {};
  IkOrientation orientation = IkOrientation::full;
  std::vector<int> dofs = {};  ///< that may move; empty: all
  int starts = 20;             ///< at most: the first from where the robot is, the others at random
  uint64_t seed = 0;           ///< of these
  double tolerance = 1e-6;     ///< > 0 [m]
  double angle_tolerance = 1e-6;  ///< > 0 [rad]
  /// only where nothing that the robot moves collides
  bool collision_free = false;
};

struct IkResult {
  bool reached = false;  ///< within both tolerances, and free of collision where that was asked for
  /// within their limits: of the first start that reached it, else the nearest
  Eigen::VectorXd dofs;
  double distance = 0;   ///< from the target there [m]
  double angle = 0;      ///< the same [rad]; of what counts
  int starts = 0;        ///< that it took
  int iterations = 0;    ///< of all starts
  int in_collision = 0;  ///< starts that reached the target but collided
};

/// Levenberg and Marquardt's method within the limits: DOFs that would leave their range stay at
/// its end. A turn by 1 rad counts as a way of 0.1 m. All joints follow their DOFs. The world stays
/// as it is.
/// body     one that the robot's joints move: its own, or one of a robot that it carries
/// throws   Error when no DOF moves the body, or an option is out of range
/// source   Sugihara (2011), Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt
///          method, IEEE T-RO 27
IkResult inverse_kinematics(const World& world, Id<Robot> robot, Id<Body> body, const Pose& X_WT,
                            const IkOptions& options = {}, QueryContext* context = nullptr);

/// Values within the limits, each as likely as any other; DOFs that turn without end get a turn
/// about where they are.
Eigen::VectorXd random_posture(const World& world, Id<Robot> robot, Random& random);

}  // namespace clench
