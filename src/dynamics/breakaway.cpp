// Stepper: joints that leave their breakaway DOF.
#include <algorithm>

#include "clench/dynamics/stepper.h"

namespace clench {

// A joint of a breakaway DOF leaves it when more is asked of it, in the sense in which the DOF
// closes, than its clutch gives; the last one that follows stays.
void Stepper::disengage() {
  DynamicState& state = world_.edit_dynamics();
  for (size_t t = 0; t < trees_.size(); ++t) {
    const Articulation& tree = system_.trees[t];
    const auto may_leave = [&](const ArticulationJoint& joint) {
      const Robot& robot = world_.robot(joint.robot);
      const DofSpec& dof = robot.dofs[robot.joints[joint.joint].dof];
      return world_.dynamic_settings().robot(joint.robot).breakaway &&
             dof.kind == DofKind::breakaway && dof.breakaway_torque > 0 &&
             world_.follows_dof(joint.robot, joint.joint);
    };
    if (std::ranges::none_of(tree.joints, may_leave)) continue;
    std::vector<Vector6d> loads(tree.bodies.size(), Vector6d::Zero());
    const auto add = [&](Id<Body> id, const Eigen::Vector3d& p_W, const Eigen::Vector3d& force,
                         const Eigen::Vector3d& torque) {
      const System::Place place = system_.place(id);
      if (place.tree != static_cast<int>(t)) return;
      loads[place.body].head<3>() += force;
      loads[place.body].tail<3>() += torque + (p_W - trees_[t].about()).cross(force);
    };
    for (const TouchingPoint& touch : touches_) {
      const Manifold& m = state.manifolds[touch.manifold];
      const ManifoldPoint& p = m.points[touch.point];
      const Eigen::Vector3d force = world_.pose(m.a).rotation * p.force,
                            torque = p.torsion * touch.frame.col(0);
      add(m.a, touch.p_W, -force, -torque);
      add(m.b, touch.p_W, force, torque);
    }
    for (size_t b = 0; b < tree.bodies.size(); ++b) {
      const Load& load = state.loads[tree.bodies[b].body.index];
      add(tree.bodies[b].body, trees_[t].com(static_cast<int>(b)), load.force, load.torque);
    }
    const auto& efforts =
        trees_[t].inverse_dynamics(v_before_, (v_ - v_before_) / tree_times_[t],
                                   root_twist(static_cast<int>(t)), world_.gravity(), loads);
    for (size_t i = 0; i < tree.joints.size(); ++i) {
      const ArticulationJoint& joint = tree.joints[i];
      if (!may_leave(joint)) continue;
      const Robot& robot = world_.robot(joint.robot);
      const Joint& spec = robot.joints[joint.joint];
      const DofSpec& dof = robot.dofs[spec.dof];
      const double closing = dof.default_velocity < 0 ? -1 : 1;
      if (closing * (spec.ratio < 0 ? -efforts[i] : efforts[i]) <= dof.breakaway_torque) continue;
      int following = 0;
      for (size_t j = 0; j < robot.joints.size(); ++j)
        following +=
            robot.joints[j].dof == spec.dof && world_.follows_dof(joint.robot, static_cast<int>(j));
      if (following > 1) world_.set_follows_dof(joint.robot, joint.joint, false);
    }
  }
}

}  // namespace clench
