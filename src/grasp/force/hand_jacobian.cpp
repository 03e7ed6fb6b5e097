#include "clench/grasp/force/hand_jacobian.h"

#include <cmath>

namespace clench {

namespace {

// a robot between the ground and the hand, and the link of it that carries the next one; none for
// the hand
struct MovingRobot {
  Id<Robot> robot;
  int link = -1;
};

std::vector<MovingRobot> moving_robots(const World& world, Id<Robot> hand, bool arms) {
  std::vector<MovingRobot> out = {{hand}};
  while (arms) {
    const auto& mounting = world.robot(out.back().robot).mounting;
    if (!mounting) break;
    out.push_back({mounting->parent, mounting->link});
  }
  return out;
}

// a joint at its present pose
struct StandingJoint {
  const Robot& robot;
  const RobotFrames& frames;
  int number;
};

// effect of the joint on contact i
void fill_column(Eigen::Ref<Eigen::VectorXd> column, const Grasp& grasp, const GraspMap& map, int i,
                 const Pose& X_WO, const StandingJoint& joint) {
  const auto& [robot, frames, j] = joint;
  const Eigen::Vector3d v = frames.velocity(robot, j, X_WO * grasp.points[i].p_O);
  const Eigen::Matrix3d frame = X_WO.matrix() * contact_frame(grasp.points[i].n_O);
  const int start = map.starts[i], count = map.starts[i + 1] - start;
  for (int k = 0; k < std::min(count, 3); ++k) column[start + k] = frame.col((k + 2) % 3).dot(v);
  const bool turns = robot.joints[j].kind == JointKind::revolute;
  if (count == 4) column[start + 3] = turns ? frame.col(2).dot(frames.axis(robot, j)) : 0;
}

}  // namespace

HandJacobian hand_jacobian(const World& world, const Grasp& grasp, const JacobianOptions& options) {
  check_unmoved(world, grasp);
  const GraspMap map = grasp_map(grasp.points, grasp.com);
  const Pose& X_WO = world.pose(grasp.object);
  std::vector<Eigen::VectorXd> columns;
  HandJacobian out;
  for (const MovingRobot& moving : moving_robots(world, grasp.hand, options.arms)) {
    const Robot& robot = world.robot(moving.robot);
    const auto frames = world.frames(moving.robot);
    for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(map.forces());
      for (int i = 0; i < map.contacts(); ++i) {
        const bool own = moving.robot == grasp.hand;
        const int link = own ? world.body(grasp.contacts[i].other).link : moving.link;
        if (joint_moves_link(robot, j, link))
          fill_column(column, grasp, map, i, X_WO, {robot, frames, j});
      }
      out.joints.push_back({moving.robot, j});
      columns.push_back(std::move(column));
    }
  }
  out.of_joints.resize(map.forces(), static_cast<int>(columns.size()));
  for (size_t k = 0; k < columns.size(); ++k) out.of_joints.col(static_cast<int>(k)) = columns[k];
  return out;
}

Eigen::MatrixXd dof_jacobian(const World& world, const Grasp& grasp, const HandJacobian& jacobian) {
  const Robot& hand = world.robot(grasp.hand);
  Eigen::MatrixXd out =
      Eigen::MatrixXd::Zero(jacobian.of_joints.rows(), static_cast<int>(hand.dofs.size()));
  for (size_t k = 0; k < jacobian.joints.size(); ++k) {
    const JointRef& ref = jacobian.joints[k];
    if (ref.robot != grasp.hand || !world.follows_dof(grasp.hand, ref.joint)) continue;
    const Joint& joint = hand.joints[ref.joint];
    out.col(joint.dof) += joint.ratio * jacobian.of_joints.col(static_cast<int>(k));
  }
  return out;
}

}  // namespace clench
