#include "clench/dynamics/stepper.h"

#include <algorithm>
#include <cmath>

#include "clench/dynamics/mover.h"
#include "clench/model/advance.h"
#include "clench/model/near_bodies.h"

namespace clench {

Stepper::Stepper(World& world) : world_(world) { refresh(); }

// The system follows from the model, the settings, and which joints follow their DOFs.
void Stepper::refresh() {
  world_.edit_dynamics();
  std::vector<unsigned char> follows;
  for (const auto id : world_.robots()) {
    const Robot& robot = world_.robot(id);
    for (size_t j = 0; j < robot.joints.size(); ++j) {
      // joints on springs are never where their tendon is
      if (robot.dofs[robot.joints[j].dof].kind == DofKind::compliant) world_.set_follows_dof(id, static_cast<int>(j), false);
      follows.push_back(world_.follows_dof(id, static_cast<int>(j)));
    }
  }
  if (stamp_ == world_.model().stamp && settings_stamp_ == world_.settings().stamp && follows == follows_) return;
  stamp_ = world_.model().stamp;
  settings_stamp_ = world_.settings().stamp;
  follows_ = std::move(follows);
  system_ = find_system(world_);
  trees_.resize(system_.trees.size());
  forces_.resize(system_.trees.size());
  tree_rows_.resize(system_.trees.size());
}

namespace {

// How far apart a pair was when it was last measured, and how far it has moved since.
bool may_have_met(const World& world, const Manifold& m) {
  // distances are exact but for rounding
  constexpr double certain = 0.999;
  return displacement(m.X_AB, relative_pose(world, m.a, m.b), *world.body(m.b).shape) >= certain * m.clear;
}

}  // namespace

double Stepper::largest_travel(double dt) const {
  const DynamicState& state = *world_.dynamics();
  double travel = 0;
  for (const auto id : world_.bodies()) {
    const Twist& twist = state.twists[id.index];
    const Body& body = world_.body(id);
    if (!body.shape || twist.is_zero()) continue;
    const double radius = body.shape->radius() + (body.shape->centre() - body.com).norm();
    travel = std::max(travel, dt * (twist.linear.norm() + twist.angular.norm() * radius));
  }
  return travel;
}

double Stepper::move(double dt) {
  refresh();
  find_manifolds(world_, system_, largest_travel(dt));
  DynamicState& state = world_.edit_dynamics();
  std::vector<Pose> before;
  for (const Manifold& m : state.manifolds) before.push_back(relative_pose(world_, m.a, m.b));
  Mover mover(world_, system_);
  mover.place(dt);

  // What moves farther than so many thresholds in a step is followed all the way; others are looked at where they arrive.
  constexpr double short_way = 10;
  std::vector<int> suspects;
  std::vector<PairBound> watches;
  std::vector<std::pair<int, Manifold>> measured;
  for (int i = 0; i < static_cast<int>(state.manifolds.size()); ++i) {
    const Manifold& m = state.manifolds[i];
    if (!may_have_met(world_, m)) continue;
    suspects.push_back(i);
    if (m.clear == 0) continue;  // they overlap: nothing to stop
    const double way = displacement(before[i], relative_pose(world_, m.a, m.b), *world_.body(m.b).shape);
    if (way <= short_way * world_.contact_threshold()) {
      Manifold there = m;
      measure(world_, there);
      if (there.clear > 0) {
        measured.emplace_back(i, std::move(there));
        continue;
      }
    }
    // the bound holds on the whole way, which is longer than the chord of a turn
    watches.push_back({.a = m.a, .b = m.b, .speed = 1.1 * way / dt});
  }
  double passed = dt;
  if (!watches.empty()) {
    int queries = 0;
    const Advance advance = clench::advance(world_, watches, dt, [&](double s) { mover.place(s); }, queries, 1000);
    // a pair that starts with next to no gap still gets on
    constexpr double least = 1e-3;
    passed = std::clamp(advance.s, least * dt, dt);
    if (passed < dt) ++state.report.impacts;
  }
  mover.finish(passed);
  if (passed < dt)
    for (const int i : suspects) measure(world_, state.manifolds[i]);
  else {
    for (auto& [i, there] : measured) state.manifolds[i] = std::move(there);
    for (const PairBound& watch : watches)
      for (const int i : suspects)
        if (state.manifolds[i].a == watch.a && state.manifolds[i].b == watch.b) measure(world_, state.manifolds[i]);
  }
  for (Manifold& m : state.manifolds) m.X_AB_left = relative_pose(world_, m.a, m.b);
  state.time += passed;
  return passed;
}

void Stepper::run(double duration) {
  const double end = world_.time() + duration;
  const double step = world_.dynamic_settings().step;
  while (world_.time() < end) {
    world_.context().progress().check();
    const double left = end - world_.time();
    // a rest that is rounding belongs to the step before
    const double h = move(left < step * (1 + 1e-9) ? left : step);
    if (left - h <= step * 1e-9) world_.edit_dynamics().time = end;
    solve(h);
  }
}

}  // namespace clench
