// Links and joints of robots by chain and number, as tests name them.
#pragma once
#include "clench/model/robot.h"

namespace clench::test {

inline const LinkSpec& link_of(const RobotSpec& robot, int chain, int link) {
  return robot.links.at(chains_of(robot).at(chain).links.at(link));
}
inline LinkSpec& link_of(RobotSpec& robot, int chain, int link) {
  return const_cast<LinkSpec&>(link_of(std::as_const(robot), chain, link));
}
inline Id<Body> link_of(const Robot& robot, int chain, int link) {
  return robot.links.at(robot.chains.at(chain).links.at(link)).body;
}

inline const JointSpec& joint_of(const RobotSpec& robot, int chain, int joint) {
  for (const NumberedJoint& at : joints_of(robot))
    if (at.chain == chain && at.number == joint) return *at.joint;
  throw std::out_of_range("no such joint");
}
inline JointSpec& joint_of(RobotSpec& robot, int chain, int joint) {
  return const_cast<JointSpec&>(joint_of(std::as_const(robot), chain, joint));
}

/// Its number in the robot.
inline int joint_number(const Robot& robot, int chain, int joint) {
  for (const int link : robot.chains.at(chain).links)
    for (int j = robot.links[link].first_joint; j < robot.links[link].end_joint; ++j)
      if (joint-- == 0) return j;
  throw std::out_of_range("no such joint");
}
inline const Joint& joint_of(const Robot& robot, int chain, int joint) {
  return robot.joints[joint_number(robot, chain, joint)];
}
}  // namespace clench::test
