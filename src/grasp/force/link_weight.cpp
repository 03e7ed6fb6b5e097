#include "clench/grasp/force/link_weight.h"

#include "clench/model/carrying.h"

namespace clench {

double link_weight(const World& world, const JointRef& ref) {
  const Robot& robot = world.robot(ref.robot);
  const auto frames = world.frames(ref.robot);
  const Eigen::Vector3d origin = frames.joints[ref.joint].position;
  const Eigen::Vector3d z = frames.axis(robot, ref.joint);
  const bool turns = robot.joints[ref.joint].kind == JointKind::revolute;
  double sum = 0;
  for (const Id<Body> id : world.bodies()) {
    if (!world.body(id).robot || !joint_moves(world, ref.robot, ref.joint, id)) continue;
    const Body& body = world.body(id);
    const Eigen::Vector3d weight = world.gravity() * (body.mass * (1 - body.gravity_compensation));
    const Eigen::Vector3d arm = world.pose(id) * body.com - origin;
    sum += turns ? z.dot(arm.cross(weight)) : z.dot(weight);
  }
  return sum;
}

}  // namespace clench
