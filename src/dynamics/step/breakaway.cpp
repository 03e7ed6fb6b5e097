#include "clench/dynamics/step/breakaway.h"

#include <algorithm>

namespace clench {

void disengage_joints(World& world, const System& system, StepProblem& problem,
                      const Eigen::VectorXd& v) {
  const DynamicState& state = *world.dynamics();
  for (size_t t = 0; t < system.trees.size(); ++t) {
    const Articulation& tree = system.trees[t];
    const auto may_leave = [&](const ArticulationJoint& joint) {
      const Robot& robot = world.robot(joint.robot);
      const DofSpec& dof = robot.dofs[robot.joints[joint.joint].dof];
      return world.dynamic_settings().robot(joint.robot).breakaway &&
             dof.kind == DofKind::breakaway && dof.breakaway_torque > 0 &&
             world.follows_dof(joint.robot, joint.joint);
    };
    if (std::ranges::none_of(tree.joints, may_leave)) continue;
    std::vector<Vector6d> loads(tree.bodies.size(), Vector6d::Zero());
    const auto add = [&](Id<Body> id, const Eigen::Vector3d& p_W, const Eigen::Vector3d& force,
                         const Eigen::Vector3d& torque) {
      const System::Place place = system.place(id);
      if (place.tree != static_cast<int>(t)) return;
      loads[place.body].head<3>() += force;
      loads[place.body].tail<3>() += torque + (p_W - problem.trees[t].about()).cross(force);
    };
    for (const TouchingPoint& touch : problem.touches) {
      const Manifold& m = state.manifolds[touch.manifold];
      const ManifoldPoint& p = m.points[touch.point];
      const Eigen::Vector3d force = world.pose(m.a).rotation * p.force,
                            torque = p.torsion * touch.frame.col(0);
      add(m.a, touch.p_W, -force, -torque);
      add(m.b, touch.p_W, force, torque);
    }
    for (size_t b = 0; b < tree.bodies.size(); ++b) {
      const Load& load = state.loads[tree.bodies[b].body.index];
      add(tree.bodies[b].body, problem.trees[t].com(static_cast<int>(b)), load.force, load.torque);
    }
    const auto& efforts = problem.trees[t].inverse_dynamics(
        problem.v_before, (v - problem.v_before) / problem.tree_times[t],
        prescribed_twist(world, tree), world.gravity(), loads);
    for (size_t i = 0; i < tree.joints.size(); ++i) {
      const ArticulationJoint& joint = tree.joints[i];
      if (!may_leave(joint)) continue;
      const Robot& robot = world.robot(joint.robot);
      const Joint& spec = robot.joints[joint.joint];
      const DofSpec& dof = robot.dofs[spec.dof];
      const double closing = dof.default_velocity < 0 ? -1 : 1;
      if (closing * (spec.ratio < 0 ? -efforts[i] : efforts[i]) <= dof.breakaway_torque) continue;
      int following = 0;
      for (size_t j = 0; j < robot.joints.size(); ++j)
        following +=
            robot.joints[j].dof == spec.dof && world.follows_dof(joint.robot, static_cast<int>(j));
      if (following > 1) world.set_follows_dof(joint.robot, joint.joint, false);
    }
  }
}

}  // namespace clench
