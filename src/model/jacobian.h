// Jacobians of a point on a robot, by joints and by DOFs.
#pragma once
#include "clench/model/world.h"

namespace clench {

/// 6 x joints: linear velocity of a point of a link, above the link's angular velocity, in the axes
/// of `frames` [m and rad per unit of the joint]; columns of joints that do not move the link are
/// 0.
/// link  -1: the base
/// p     in that frame [m]
/// source  Lynch & Park (2017), Modern Robotics, sec. 5.1: the geometric Jacobian
Eigen::MatrixXd joint_jacobian(const Robot& robot, const RobotFrames& frames, int link,
                               const Eigen::Vector3d& p);

/// 6 x DOFs, in world axes: each column is the combined motion of the DOF's joints that follow it,
/// by their ratios.
/// body  a part of the robot, or of a robot that it carries; any other has no velocity
Eigen::MatrixXd dof_jacobian(const World& world, Id<Robot> robot, Id<Body> body,
                             const Eigen::Vector3d& p_W);

}  // namespace clench
