// Contacts whose normal velocity no coordinate changes, or hardly any.
#include <cmath>
#include <numbers>

#include "clench/base/random.h"
#include "clench/dynamics/stepper.h"
#include "support/cases.h"
#include "support/pendulums.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

namespace {

constexpr double width = 0.1;  // of the puck [m]

JointSpec slide(const Vector3d& axis, int dof) {
  JointSpec joint;
  joint.kind = JointKind::prismatic;
  joint.axis = axis.normalized();
  joint.dof = dof;
  joint.min = -10, joint.max = 10;
  return joint;
}

// A puck of 1 kg on joints in series, the first of them on a base high above.
RobotSpec puck(const std::vector<JointSpec>& joints) {
  RobotSpec robot;
  robot.name = "puck";
  robot.base = body_spec("puck_base", moved(box(width, width, width), {0, 0, 2}));
  LinkSpec link{.body = body_spec("puck_link", box(width, width, width))};
  link.body.mass = 1;
  link.joints = joints;
  robot.dofs.resize(joints.size());
  robot.links.push_back(link);
  return robot;
}

struct Floor {
  World world;
  Id<Robot> id;

  Floor(const RobotSpec& spec, double gap) {
    world.add_body(body_spec("floor", moved(box(40, 40, 1), {0, 0, -width / 2 - 0.5 - gap})),
                   BodyKind::obstacle, {});
    id = add_free_robot(world, spec);
    world.set_collision(true);
  }
  double speed() const {
    const Twist twist = world.twist(world.robot(id).links[0].body);
    return twist.linear.norm() + width * twist.angular.norm();
  }
};

}  // namespace

TEST_CASE("a puck on two slides across the contact's normal stays at rest") {
  Floor floor(puck({slide({1, 0, 0}, 0), slide({0, 1, 0}, 1)}), 1e-5);
  Stepper(floor.world).run(0.1);
  CHECK(floor.world.dynamics()->report.contacts == 4);
  CHECK(floor.world.dynamics()->report.failures == 0);
  CHECK(floor.world.twist(floor.world.robot(floor.id).links[0].body).is_zero());
}

TEST_CASE(
    "chains that hardly move along a contact's normal gain no energy, and every step is solved") {
  Random random(7);
  for (int round = 0; round < cases(60); ++round) {
    const double tilt = round % 6 == 0 ? 0 : std::pow(10, random.uniform(-15, -1));
    const double yaw = random.uniform(0, 2 * std::numbers::pi);
    const Vector3d along(std::cos(yaw), std::sin(yaw), 0), across(-along.y(), along.x(), 0);
    std::vector<JointSpec> joints = {slide(along, 0), slide(across + Vector3d(0, 0, tilt), 1)};
    if (round % 3 == 1) joints.push_back(slide(along + across, 2));  // redundant
    if (round % 3 == 2) {
      JointSpec hinge = slide({0, 0, 1}, 2);
      hinge.kind = JointKind::revolute;
      joints.push_back(hinge);
    }
    // separated, at rest, or slightly overlapping
    Floor floor(puck(joints), random.uniform(-1e-5, 6e-5));
    Eigen::VectorXd v(static_cast<Eigen::Index>(joints.size()));
    for (double& x : v) x = random.uniform(-0.1, 0.1);
    floor.world.set_dof_velocities(floor.id, v);
    const double before = v.cwiseAbs().sum(), seconds = 0.1;
    Stepper(floor.world).run(seconds);
    CAPTURE(tilt);
    CHECK(floor.world.dynamics()->report.failures == 0);
    // gravity pulls along a slide of this tilt; contacts push by less than a tenth of the speed
    CHECK(floor.speed() < before + g * tilt * seconds + 0.01);
  }
}
