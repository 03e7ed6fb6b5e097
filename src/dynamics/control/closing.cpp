#include "clench/dynamics/control/closing.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/text.h"
#include "clench/model/dof.h"

namespace clench {

void send_dof(World& world, Id<Robot> id, int dof, double target, double velocity) {
  const Robot& robot = world.robot(id);
  DynamicState& state = world.edit_dynamics();
  const size_t index = robot.first_dof + static_cast<size_t>(dof);
  const double q = world.dofs(id)[dof];
  // the maximum speed of a quintic trajectory, at half its time, is 15/8 of the mean
  constexpr double peak = 15.0 / 8;
  DofControl& control = state.controls[index];
  control.mode = ControlMode::position;
  control.target = target;
  control.velocity = 0;
  control.trajectory = Trajectory{.from = q,
                                  .to = target,
                                  .begin = state.time,
                                  .duration = peak * std::abs(target - q) / velocity};
}

void close_by_motors(World& world, Id<Robot> id, double speed) {
  const Robot& robot = world.robot(id);
  if (!std::isfinite(speed) || speed == 0)
    fail("closing '{}' by its motors: expected a speed that is not 0, got {}", excerpt(robot.name),
         speed);
  // default velocities are relative speeds of DOFs; some files give them in millimeters per second
  constexpr double longest = 3;  // [s]
  std::vector<double> ends(robot.dofs.size()), rates(robot.dofs.size());
  std::vector<std::string> without_motor;
  double slowest = 0;
  for (size_t d = 0; d < robot.dofs.size(); ++d) {
    if (robot.dofs[d].default_velocity != 0 && !robot.dofs[d].driven) {
      without_motor.push_back(dof_name(robot, static_cast<int>(d)));
      continue;
    }
    rates[d] = speed * robot.dofs[d].default_velocity;
    if (rates[d] == 0) continue;
    ends[d] = range_around(robot, static_cast<int>(d),
                           world.dofs(id)[static_cast<int>(d)])[rates[d] > 0 ? 1 : 0];
    slowest = std::max(
        slowest, std::abs(ends[d] - world.dofs(id)[static_cast<int>(d)]) / std::abs(rates[d]));
  }
  const bool none_moves = std::ranges::all_of(rates, [](double rate) { return rate == 0; });
  if (none_moves && !without_motor.empty())
    fail("closing '{}' by its motors: no motor drives any of the DOFs that close it: {}",
         excerpt(robot.name), name_list(without_motor));
  const double faster = std::max(1.0, slowest / (longest / std::abs(speed)));
  for (size_t d = 0; d < robot.dofs.size(); ++d)
    if (rates[d] != 0)
      send_dof(world, id, static_cast<int>(d), ends[d], faster * std::abs(rates[d]));
}

// GraspIt!'s criterion: each chain's last link touches something, or its last joint is within 0.03
// of its limit
bool has_closed(const World& world, Id<Robot> id) {
  constexpr double near = 0.03, still = 1e-3;  // [rad or m], [rad/s or m/s]
  const Robot& robot = world.robot(id);
  const DynamicState* state = world.dynamics();
  for (const Chain& chain : robot.chains) {
    if (chain.links.empty()) continue;
    const int last = chain.links.back();
    const Id<Body> body = robot.links[last].body;
    bool done = false;
    if (state)
      for (const Manifold& m : state->manifolds)
        done = done || ((m.a == body || m.b == body) && !m.points.empty());
    const auto joints = joints_of(robot, chain);
    if (!joints.empty()) {
      const Joint& joint = robot.joints[joints.back()];
      const double rate = robot.dofs[joint.dof].default_velocity;
      const double q = world.dofs(id)[joint.dof];
      const DofControl control = world.control(id, joint.dof);
      const bool over = control.trajectory &&
                        world.time() >= control.trajectory->begin + control.trajectory->duration;
      done = done || (over && std::abs(world.dof_velocities(id)[joint.dof]) < still);
      done = done || rate == 0 ||
             std::abs(range_around(robot, joint.dof, q)[rate > 0 ? 1 : 0] - q) < near;
    }
    if (!done) return false;
  }
  return true;
}

}  // namespace clench
