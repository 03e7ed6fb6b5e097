#include "grasp/hand_jacobian.h"

#include <cmath>

namespace clench {

namespace {

// a robot on the way from the ground to the hand, and the link of it that carries the next one; the hand: none
struct Carrier {
  Id<Robot> robot;
  int chain = -1, link = -1;
};

std::vector<Carrier> carriers(const World& world, Id<Robot> hand, bool arms) {
  std::vector<Carrier> out = {{hand}};
  while (arms) {
    const auto& mounting = world.robot(out.back().robot).mounting;
    if (!mounting) break;
    const auto& chains = world.robot(mounting->parent).chains;
    const int last = static_cast<int>(chains[mounting->chain].links.size()) - 1;
    out.push_back({mounting->parent, mounting->chain, last});
  }
  return out;
}

// the column of one joint: axis in the world
void fill_column(Eigen::Ref<Eigen::VectorXd> column, const Grasp& grasp, const GraspMap& map, int i,
                 const Pose& X_WO, JointKind kind, const Pose& axis) {
  const bool turns = kind == JointKind::revolute;
  const Eigen::Vector3d z = axis.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d p_W = X_WO * grasp.points[i].p_O;
  const Eigen::Vector3d v = turns ? Eigen::Vector3d(z.cross(p_W - axis.position)) : z;
  const Eigen::Matrix3d frame = X_WO.matrix() * contact_frame(grasp.points[i].n_O);
  const int start = map.starts[i], count = map.starts[i + 1] - start;
  for (int k = 0; k < std::min(count, 3); ++k) column[start + k] = frame.col((k + 2) % 3).dot(v);
  if (count == 4) column[start + 3] = turns ? frame.col(2).dot(z) : 0;
}

}  // namespace

HandJacobian hand_jacobian(const World& world, const Grasp& grasp, const JacobianOptions& options) {
  check_unmoved(world, grasp);
  const GraspMap map = grasp_map(grasp.points, grasp.com);
  const Pose& X_WO = world.body(grasp.object).X_WB;
  std::vector<Eigen::VectorXd> columns;
  HandJacobian out;
  for (const Carrier& carrier : carriers(world, grasp.hand, options.arms)) {
    const Robot& robot = world.robot(carrier.robot);
    const Pose& X_WB = world.body(robot.base).X_WB;
    const auto frames = chain_frames(robot);
    for (int c = 0; c < static_cast<int>(robot.chains.size()); ++c)
      for (int j = 0; j < static_cast<int>(robot.chains[c].joints.size()); ++j) {
        Eigen::VectorXd column = Eigen::VectorXd::Zero(map.forces());
        for (int i = 0; i < map.contacts(); ++i) {
          const Body& part = world.body(grasp.contacts[i].other);
          const bool own = carrier.chain < 0;
          const int chain = own ? part.chain : carrier.chain;
          const int link = own ? part.link : carrier.link;
          if (chain < 0 || !joint_moves_link(robot, c, j, chain, link)) continue;
          fill_column(column, grasp, map, i, X_WO, robot.chains[c].joints[j].kind,
                      X_WB * frames[c].axes[j]);
        }
        out.joints.push_back({carrier.robot, c, j});
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
    if (ref.robot != grasp.hand || hand.chains[ref.chain].apart[ref.joint]) continue;
    const JointSpec& joint = hand.chains[ref.chain].joints[ref.joint];
    out.col(joint.dof) += joint.ratio * jacobian.of_joints.col(static_cast<int>(k));
  }
  return out;
}

}  // namespace clench
