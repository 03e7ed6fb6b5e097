#include "clench/dynamics/stepper.h"

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/base/watched.h"
#include "clench/dynamics/contact/manifolds.h"
#include "clench/dynamics/move/meetings.h"
#include "clench/dynamics/step/apply_step.h"
#include "clench/dynamics/step/free_motion.h"
#include "clench/dynamics/step/solve_by_ode.h"
#include "clench/dynamics/step/step_rows.h"

namespace clench {

// A smaller fraction of a step counts as no time.
static constexpr double rounding = 1e-6;

Stepper::Stepper(World& world) : world_(world) { refresh(); }

// The system depends on the model, the settings, and which joints follow their DOFs.
void Stepper::refresh() {
  world_.edit_dynamics();
  std::vector<unsigned char> follows;
  for (const auto id : world_.robots()) {
    const Robot& robot = world_.robot(id);
    for (size_t j = 0; j < robot.joints.size(); ++j) {
      // joints on springs are never where their tendon is
      if (robot.dofs[robot.joints[j].dof].kind == DofKind::compliant)
        world_.set_follows_dof(id, static_cast<int>(j), false);
      follows.push_back(world_.follows_dof(id, static_cast<int>(j)));
    }
  }
  if (stamp_ == world_.model().stamp && settings_stamp_ == world_.settings().stamp &&
      follows == follows_)
    return;
  stamp_ = world_.model().stamp;
  settings_stamp_ = world_.settings().stamp;
  follows_ = std::move(follows);
  system_ = find_system(world_);
}

namespace {

// A step that fails or is stopped leaves the world as it was at the start of the step.
template <class Change>
void change_or_restore(World& world, Change change) {
  const std::shared_ptr<const Snapshot> before = world.snapshot();
  try {
    change();
  } catch (const std::exception&) {
    world.restore(*before);
    throw;
  }
}

// Objects that are welded to prescribed bodies move with them.
void carry_welded(World& world, const System& system) {
  DynamicState& state = world.edit_dynamics();
  for (const auto& [body, to] : system.welds)
    if (system.place(body).tree < 0) state.twists[body.index] = world.carried_twist(body, to);
}

void count_overlaps(World& world) {
  DynamicState& state = world.edit_dynamics();
  // surfaces that overlap by less only touch
  const auto is_inside = [deep = -0.01 * world.contact_threshold()](const ManifoldPoint& p) {
    return p.gap < deep;
  };
  for (const Manifold& m : state.manifolds)
    state.report.overlaps +=
        m.clearance == 0 && (m.points.empty() || std::ranges::any_of(m.points, is_inside));
}

}  // namespace

double Stepper::move(double dt) {
  double passed = 0;
  change_or_restore(world_, [&] { passed = move_bodies(dt); });
  return passed;
}

void Stepper::solve(double h) {
  change_or_restore(world_, [&] {
    refresh();
    find_manifolds(world_, system_, 0);
    solve_velocities(h);
  });
}

double Stepper::move_bodies(double dt) {
  refresh();
  const double passed = move_until_meeting(world_, system_, dt);
  DynamicState& state = world_.edit_dynamics();
  state.time += passed;
  // the same instants however a duration is divided: sums of many steps differ by rounding
  const double step = world_.dynamic_settings().step, whole = std::round(state.time / step) * step;
  if (std::abs(whole - state.time) < rounding * step) state.time = whole;
  state.whole_step = dt;
  return passed;
}

// The manifolds of the bodies at their present poses.
void Stepper::solve_velocities(double h) {
  carry_welded(world_, system_);
  for (const auto id : world_.robots()) pull_tendons(world_, id, h, world_.edit_dynamics());
  count_overlaps(world_);
  update_manifolds(world_);
  problem_.h = h;
  find_free_motion(world_, system_, problem_);
  find_rows(world_, system_, problem_);
  const DynamicSettings& settings = world_.dynamic_settings();
  const StepSolution solution =
      settings.engine == DynamicsEngine::ode
          ? solve_by_ode(world_, system_, problem_)
          : islands_.solve(system_, problem_, settings, world_.context().progress());
  apply_step(world_, system_, problem_, solution);
}

bool Stepper::step(double end) {
  const double step = world_.dynamic_settings().step;
  if (!(end - world_.time() > rounding * step)) return false;
  world_.context().progress().check();
  check_stop();
  // Steps end at multiples of the step size, also after an impact: the same instants however a
  // duration is divided.
  const double now = world_.time(), next = (std::floor(now / step + rounding) + 1) * step;
  double left = std::min(next, end) - now;
  if (!(now + left > now))
    fail(ErrorKind::limit,
         "world: a time step of {} s is below the resolution of the simulation time {} s", step,
         now);
  if (std::abs(left - step) < rounding * step) left = step;
  change_or_restore(world_, [&] {
    const double h = move_bodies(left);
    double& time = world_.edit_dynamics().time;
    if (std::abs(end - time) < rounding * step) time = end;
    refresh();
    solve_velocities(h);
  });
  return true;
}

void Stepper::run(double duration) {
  const double end = world_.time() + duration;
  while (step(end)) {
  }
}

}  // namespace clench
