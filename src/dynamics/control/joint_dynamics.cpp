#include "clench/dynamics/control/joint_dynamics.h"

#include <algorithm>

#include "clench/dynamics/control/motors.h"

namespace clench {

JointDynamics joint_dynamics(const World& world, Id<Robot> id) {
  const Robot& robot = world.robot(id);
  const auto dofs = static_cast<Eigen::Index>(robot.dofs.size());
  JointDynamics out{Eigen::MatrixXd::Zero(dofs, dofs), Eigen::VectorXd::Zero(dofs),
                    Eigen::VectorXd::Zero(dofs)};
  const System system = find_system(world);
  const auto moves = [&](const Articulation& tree) {
    return std::ranges::find(tree.robots, id) != tree.robots.end();
  };
  const auto tree = std::ranges::find_if(system.trees, moves);
  if (tree == system.trees.end()) return out;

  // edit_dynamics() completes the state of the copy, as at the start of a run
  World copy = world;
  const DynamicState& state = copy.edit_dynamics();
  Eigen::VectorXd v;
  gather_velocities(system, world, state, v);
  const Vector6d root = prescribed_twist(world, *tree);
  TreeDynamics dynamics;
  dynamics.place(world, *tree);
  Eigen::VectorXd bias = dynamics.find_bias(v, root, world.gravity());
  JointForces forces;
  // damping in the limit of short steps
  constexpr double h = 1e-9;
  find_joint_forces(world, *tree, dynamics, h, state, forces);
  const Eigen::VectorXd own = v.segment(tree->first, tree->size());
  const Eigen::VectorXd passive =
      forces.velocity_part.cwiseProduct(own) / h - (forces.efforts - forces.weight);
  bias -= forces.weight;
  Eigen::MatrixXd mass = dynamics.mass_matrix();
  mass.diagonal() += forces.added - forces.velocity_part;

  // coordinates by the DOFs that move them
  Eigen::MatrixXd ratios = Eigen::MatrixXd::Zero(tree->size(), dofs);
  for (size_t i = 0; i < tree->coordinates.size(); ++i) {
    const Coordinate& c = tree->coordinates[i];
    if (c.robot != id) continue;
    ratios(tree->root_size() + static_cast<Eigen::Index>(i), c.dof) =
        c.joint < 0 ? 1 : robot.joints[c.joint].ratio;
  }
  out.mass_matrix = ratios.transpose() * mass * ratios;
  out.bias = ratios.transpose() * bias;
  out.passive = ratios.transpose() * passive;
  return out;
}

}  // namespace clench
