// A hand of two sliding jaws around a block.
#pragma once
#include "grasp/held_object.h"

namespace clench::test {

/// Two jaws that slide along x towards each other, with a block of 40 mm between them; optionally a
/// palm that touches it from below.
struct Jaws {
  World world;
  Grasp grasp;
};

/// spring  stiffness of springs that press inwards [N/m]
/// actuators  of the joints "jaw0" and "jaw1", `dof` 0 and 1
inline Jaws jaws(DofKind kind, double mu, double max_effort, bool palm = false, double spring = 0,
                 const std::vector<ActuatorSpec>& actuators = {},
                 const std::optional<std::array<double, 2>>& effort_range = {}) {
  Jaws j;
  RobotSpec spec;
  spec.name = "jaws";
  spec.base = body_spec("palm", box(0.1, 0.02, 0.02));
  DofSpec dof;
  dof.kind = kind;
  dof.default_velocity = 1;
  dof.max_effort = max_effort;
  spec.dofs = {dof, dof};
  spec.actuators = actuators;
  for (int side = 0; side < 2; ++side) {
    const double quarter = std::numbers::pi / 2;
    // z of the joint points inwards
    const Pose X_BJ{Eigen::Quaterniond(Eigen::AngleAxisd(side == 0 ? -quarter : quarter,
                                                         Eigen::Vector3d::UnitY())),
                    {side == 0 ? 0.1 : -0.1, 0, 0.1}};
    LinkSpec link;
    link.body = body_spec("jaw" + std::to_string(side), box(0.02, 0.02, 0.02));
    link.joints = {{.name = "jaw" + std::to_string(side),
                    .kind = JointKind::prismatic,
                    .X_PJ = X_BJ,
                    .dof = side,
                    .min = 0,
                    .max = 0.1,
                    .spring = spring,
                    .rest = 0.1,
                    .effort_range = effort_range}};
    spec.links.push_back(link);
  }
  j.grasp.hand = j.world.add_robot(spec, Pose());
  j.world.set_dofs(j.grasp.hand, Eigen::Vector2d(0.07, 0.07));
  j.grasp.object = j.world.add_body(body_spec("block", box(0.04, 0.04, 0.04)), BodyKind::object,
                                    Pose::translation({0, 0, 0.1}));
  j.grasp.rho = 0.02 * std::sqrt(3.0);
  const auto touch = [&](Id<Body> part, const Eigen::Vector3d& p_O, const Eigen::Vector3d& n) {
    Contact contact;
    contact.body = j.grasp.object;
    contact.other = part;
    contact.p_W = p_O + Eigen::Vector3d(0, 0, 0.1);
    contact.n_W = n;
    j.grasp.contacts.push_back(contact);
    j.grasp.points.push_back({.p_O = p_O, .n_O = n, .mu = mu});
  };
  const auto& links = j.world.robot(j.grasp.hand).links;
  touch(links[0].body, {0.02, 0, 0}, {-1, 0, 0});
  touch(links[1].body, {-0.02, 0, 0}, {1, 0, 0});
  if (palm) touch(j.world.robot(j.grasp.hand).base, {0, 0, -0.02}, {0, 0, 1});
  return j;
}

}  // namespace clench::test
