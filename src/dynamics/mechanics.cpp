#include "clench/dynamics/mechanics.h"

#include <algorithm>

#include "clench/dynamics/control/motors.h"

namespace clench {

template <class Visit>
static void each_moving(const World& world, Visit visit) {
  for (const auto id : world.bodies()) {
    const Body& body = world.body(id);
    if (body.kind == BodyKind::obstacle) continue;
    const Eigen::Matrix3d R = world.pose(id).matrix();
    const Eigen::Matrix3d inertia = R * (body.mass * body.inertia_per_mass) * R.transpose();
    visit(body, world.pose(id) * body.com, inertia, world.twist(id));
  }
}

Momentum momentum(const World& world) {
  Momentum out;
  each_moving(world, [&](const Body& body, const Eigen::Vector3d& com,
                         const Eigen::Matrix3d& inertia, const Twist& v) {
    const Eigen::Vector3d linear = body.mass * v.linear;
    out.linear += linear;
    out.angular += inertia * v.angular + com.cross(linear);
  });
  return out;
}

MechanicalEnergy mechanical_energy(const World& world) {
  MechanicalEnergy out;
  each_moving(world, [&](const Body& body, const Eigen::Vector3d& com,
                         const Eigen::Matrix3d& inertia, const Twist& v) {
    out.kinetic += 0.5 * (body.mass * v.linear.squaredNorm() + v.angular.dot(inertia * v.angular));
    out.potential -= (1 - body.gravity_compensation) * body.mass * world.gravity().dot(com);
  });
  for (const auto id : world.robots()) {
    const Robot& robot = world.robot(id);
    for (const JointTendonSpec& tendon : robot.joint_tendons) {
      double length = 0;
      for (const auto& [dof, arm] : tendon.arms) length += arm * world.dofs(id)[dof];
      const double away = length - std::clamp(length, tendon.slack[0], tendon.slack[1]);
      out.potential += 0.5 * tendon.stiffness * away * away;
    }
    for (size_t j = 0; j < robot.joints.size(); ++j) {
      const Joint& joint = robot.joints[j];
      const double q = world.joints(id)[static_cast<int>(j)];
      // a tendon moves its joints through springs whose rest position is where the tendon alone
      // would hold them
      const bool pulled = robot.dofs[joint.dof].kind == DofKind::compliant;
      const double stiffness =
          pulled ? tendon_stiffness(world, id, static_cast<int>(j)) : joint.spring;
      const double away = q - (pulled ? joint.ratio * world.dofs(id)[joint.dof] : joint.rest);
      out.potential += 0.5 * stiffness * away * away;
      if (const DynamicState* state = world.dynamics();
          state && robot.first_joint + j < state->joint_velocities.size()) {
        const double v = state->joint_velocities[robot.first_joint + j];
        out.kinetic += 0.5 * joint.armature * v * v;
      }
    }
  }
  return out;
}

}  // namespace clench
