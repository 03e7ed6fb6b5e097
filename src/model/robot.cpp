#include "model/robot.h"

namespace clench {

double joint_value(const Robot& robot, int joint) {
  if (robot.apart[joint]) return *robot.apart[joint];
  return robot.joints[joint].ratio * robot.q[robot.joints[joint].dof];
}

RobotFrames robot_frames(const Robot& robot) {
  RobotFrames frames;
  frames.joints.reserve(robot.joints.size());
  frames.links.reserve(robot.links.size());
  for (const Link& link : robot.links) {
    Pose at = frames.link(link.parent);
    for (int j = link.first_joint; j < link.end_joint; ++j) {
      frames.joints.push_back(at * robot.joints[j].X_PJ);
      at = frames.joints.back() * joint_motion(robot.joints[j], joint_value(robot, j));
    }
    frames.links.push_back(at * link.X_JL);
  }
  return frames;
}

bool joint_moves_link(const Robot& robot, int joint, int link) {
  const int moved = robot.joints[joint].link;
  while (link > moved) link = robot.links[link].parent;
  return link == moved;
}

}  // namespace clench
