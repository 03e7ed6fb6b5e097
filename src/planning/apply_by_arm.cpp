#include "clench/planning/apply_by_arm.h"

#include "clench/base/error.h"
#include "clench/motion/inverse_kinematics.h"

namespace clench {

void apply_by_arm(World& world, const GraspSpec& grasp, Id<Robot> hand, Id<Body> object,
                  const GraspDofOptions& options) {
  const Robot& robot = world.robot(hand);
  if (!grasp.X_OH || !robot.mounting || world.robot(robot.mounting->parent).dofs.empty() ||
      stands_as_grasped(world, grasp, hand, object))
    return apply_grasp(world, grasp, hand, object, options);
  constexpr double exact = 1e-9;  // [m], [rad]
  const auto arm = robot.mounting->parent;
  const Eigen::VectorXd before = world.dofs(arm);
  const IkResult found =
      inverse_kinematics(world, arm, robot.base, world.pose(object) * *grasp.X_OH,
                         {.tolerance = exact, .angle_tolerance = exact}, &world.context());
  if (!found.reached)
    fail(
        "grasp of {} by {}: '{}' cannot bring the hand there; at best it is {:.3g} m and {:.3g} "
        "rad away",
        world.body(object).name, robot.name, world.robot(arm).name, found.distance, found.angle);
  if (found.dofs != before) world.set_dofs(arm, found.dofs);
  try {
    apply_grasp(world, grasp, hand, object, options);
  } catch (const Error&) {
    world.set_dofs(arm, before);
    throw;
  }
}

}  // namespace clench
