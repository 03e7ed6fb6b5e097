// Robots of rods, and worlds for them, for tests of dynamics.
#pragma once
#include "clench/dynamics/stepper.h"
#include "support/robots.h"

namespace clench::test {

/// A chain of rods of length 1 m and 1 kg that hang along -z, each turning about y (or a given
/// axis) at its upper end, with one DOF each, without gains of motors and with very wide limits.
inline RobotSpec pendulum(int rods, const std::vector<Eigen::Vector3d>& axes = {}) {
  RobotSpec robot;
  robot.name = "pendulum";
  robot.base = body_spec("pendulum_base", box(0.1, 0.1, 0.1));
  robot.chain_links_collide = false;
  for (int i = 0; i < rods; ++i) {
    DofSpec dof;
    robot.dofs.push_back(dof);
    LinkSpec link{
        .body = body_spec("rod" + std::to_string(i), moved(box(0.02, 0.03, 1), {0, 0, -0.5}))};
    link.body.mass = 1;
    link.parent = i - 1;
    JointSpec joint;
    joint.X_PJ = Pose::translation({0, 0, i == 0 ? 0.0 : -1.0});
    joint.axis =
        i < static_cast<int>(axes.size()) ? axes[i].normalized() : Eigen::Vector3d::UnitY();
    joint.dof = i;
    joint.min = -100;
    joint.max = 100;
    link.joints = {joint};
    robot.links.push_back(link);
  }
  return robot;
}

/// Adds a robot without collisions and motor efforts, subject to gravity.
inline Id<Robot> add_free_robot(World& world, const RobotSpec& spec, bool floating = false) {
  const auto id = world.add_robot(spec, {});
  world.set_collision(false);
  DynamicSettings settings = world.dynamic_settings();
  settings.robots[id] = {.floating = floating, .gravity_compensation = false, .gains = {}};
  world.set_dynamic_settings(settings);
  for (DofControl& control : world.edit_dynamics().controls) control.mode = ControlMode::effort;
  return id;
}

inline constexpr double g = 9.81;  // [m/s^2]

inline void set_step(World& world, double step) {
  DynamicSettings settings = world.dynamic_settings();
  settings.step = step;
  world.set_dynamic_settings(settings);
}

inline void run(World& world, double seconds) { Stepper(world).run(seconds); }

/// A box or other mesh on a large plate whose upper side is z = 0 of a plane tilted about y by an
/// angle.
struct Slope {
  World world;
  Id<Body> ground;
  Pose X_WS;

  explicit Slope(double angle = 0, double mu = 0.5) {
    X_WS = Pose::turn(angle, Eigen::Vector3d::UnitY());
    BodySpec plate = body_spec("plate", moved(box(20, 4, 0.2), {0, 0, -0.1}));
    ground = world.add_body(plate, BodyKind::obstacle, X_WS);
    world.set_friction("wood", "wood", {.statics = mu, .kinetic = mu});
  }
  Id<Body> put(const std::string& name, Mesh mesh, double mass, const Pose& X_SB) {
    BodySpec spec = body_spec(name, std::move(mesh));
    spec.mass = mass;
    return world.add_body(spec, BodyKind::object, X_WS * X_SB, name);
  }
  /// velocity along the slope's x, downhill for angle > 0
  double speed(Id<Body> id) const {
    return (X_WS.rotation.conjugate() * world.twist(id).linear).x();
  }
};

}  // namespace clench::test
