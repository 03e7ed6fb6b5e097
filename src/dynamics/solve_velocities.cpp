// Stepper::solve_found: forces, contacts, limits and motors give new velocities.
#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/dynamics/stepper.h"

namespace clench {

Vector6d Stepper::root_twist(int tree) const {
  return prescribed_twist(world_, system_.trees[tree]);
}

// Do joints, or a floating base, turn by more than half a radian in the step? What that causes
// would grow from step to step.
bool Stepper::whirls(int tree, double h) const {
  constexpr double max_turn = 0.5;  // [rad]
  const Articulation& of = system_.trees[tree];
  return !of.is_free_body() && of.size() > 0 &&
         v_.segment(of.first, of.size()).cwiseAbs().maxCoeff() * h > max_turn;
}

// What velocities cause is quadratic in them: taken at those of the step's middle rather than of
// its beginning a double pendulum gains a twentieth of the energy. c(v + d) = c(v) + (c(v + d) -
// c(v - d)) / 2 but for what is quadratic in d, half the change.
void Stepper::add_mean_bias(int tree, double h, Eigen::VectorXd& change) {
  auto v = v_.segment(system_.trees[tree].first, system_.trees[tree].size());
  constexpr double slow = 1e-3;  // what all but rests has none
  if (v.cwiseAbs().maxCoeff() < slow || whirls(tree, h)) return;
  TreeDynamics& dynamics = trees_[tree];
  const Vector6d root = root_twist(tree);
  const Eigen::VectorXd before = v;
  v = before - change / 2;
  Eigen::VectorXd more = dynamics.find_bias(v_, root, world_.gravity());
  v = before + change / 2;
  more -= dynamics.find_bias(v_, root, world_.gravity());
  v = before;
  more /= 2;
  forces_[tree].efforts += more;
  more *= h;
  dynamics.half_solve(more);
  dynamics.other_half_solve(more);
  change += more;
}

void Stepper::find_free_velocities(double h) {
  const DynamicState& state = *world_.dynamics();
  gather_velocities(system_, world_, state, v_);
  v_before_ = v_;
  for (size_t t = 0; t < trees_.size(); ++t) {
    check_stop();
    const Articulation& tree = system_.trees[t];
    TreeDynamics& dynamics = trees_[t];
    const int n = tree.size();
    dynamics.place(world_, tree);
    if (n == 0) continue;
    // forces that velocities cause are left out there
    const Eigen::VectorXd still =
        whirls(static_cast<int>(t), h) ? Eigen::VectorXd::Zero(v_.size()) : Eigen::VectorXd();
    Eigen::VectorXd efforts = -dynamics.find_bias(
        still.size() > 0 ? still : v_, root_twist(static_cast<int>(t)), world_.gravity());
    find_joint_forces(world_, tree, dynamics, h, state, forces_[t]);
    efforts += forces_[t].efforts;
    for (size_t i = 0; i < tree.coordinates.size(); ++i)
      efforts[tree.root_size() + static_cast<int>(i)] +=
          feedforward_effort(world_, tree.coordinates[i], state);
    for (size_t b = 0; b < tree.bodies.size(); ++b) {
      const Load& load = state.loads[tree.bodies[b].body.index];
      if (load.force.isZero(0) && load.torque.isZero(0)) continue;
      const int body = static_cast<int>(b);
      dynamics.add_linear(body, dynamics.com(body), load.force, 1, efforts);
      dynamics.add_angular(body, load.torque, 1, efforts);
    }
    auto v = v_.segment(tree.first, n);
    dynamics.factor(forces_[t].added, forces_[t].root_added);
    Eigen::VectorXd rhs = h * efforts - forces_[t].velocity_part.cwiseProduct(v);
    if (const auto& damped = forces_[t].root_velocity_part; damped.size() > 0)
      rhs.head<6>() -= damped * v.head<6>();
    if (!tree.floating) {
      Vector6d last;
      last << state.solved[tree.root.index].linear, state.solved[tree.root.index].angular;
      rhs += dynamics.base_impulse(root_twist(static_cast<int>(t)) - last);
    }
    dynamics.half_solve(rhs);
    dynamics.other_half_solve(rhs);
    if (n > 1 && !tree.is_free_body()) add_mean_bias(static_cast<int>(t), h, rhs);
    v += rhs;
  }
}

// An impulse of bodies that meet at the end of a step cut short, and of all that touches them, is
// no force of that short time.
void Stepper::find_times(double h) {
  const double whole = std::max(h, world_.dynamics()->whole_step);
  tree_times_.assign(trees_.size(), h);
  for (PlacedBlock& block : blocks_) block.time = h;
  if (h == whole) return;
  for (const Island& island : islands_) {
    if (std::ranges::none_of(island.blocks, [&](int i) { return blocks_[i].meets; })) continue;
    for (const int i : island.blocks) blocks_[i].time = whole;
    for (const int t : island.trees) tree_times_[t] = whole;
  }
}

// What the next step, and whoever looks, wants of this one.
void Stepper::keep() {
  DynamicState& state = world_.edit_dynamics();
  scatter_velocities(system_, world_, v_, state);
  for (size_t t = 0; t < trees_.size(); ++t) {
    const Articulation& tree = system_.trees[t];
    const Vector6d root = root_twist(static_cast<int>(t));
    for (size_t b = 0; b < tree.bodies.size(); ++b)
      if (tree.bodies[b].body != tree.root)
        state.twists[tree.bodies[b].body.index] =
            trees_[t].twist(static_cast<int>(b), v_.segment(tree.first, tree.size()), root);
  }
  state.solved = state.twists;
  for (Manifold& m : state.manifolds)
    for (ManifoldPoint& p : m.points) p.force.setZero(), p.torsion = 0;
  state.row_forces.clear();
  for (const Articulation& tree : system_.trees)
    for (const Coordinate& c : tree.coordinates)
      if (c.joint < 0) state.dof_efforts[c.dof_index] = feedforward_effort(world_, c, state);
  for (const PlacedBlock& block : blocks_) {
    const int row = block.law.row;
    const double time = block.time;
    if (block.row >= 0) {
      const CoordinateRow& c = coordinate_rows_[block.row];
      state.row_forces.push_back({c.kind, c.index, r_[row] / time});
      if (c.kind == RowKind::motor) state.dof_efforts[c.index] += r_[row] / time;
      continue;
    }
    const TouchingPoint& touch = touches_[block.touch];
    Manifold& m = state.manifolds[touch.manifold];
    ManifoldPoint& p = m.points[touch.point];
    const int linear = std::min(block.law.size(), 3);
    const Eigen::Vector3d impulse =
        touch.frame.leftCols(linear) * Eigen::Map<const Eigen::VectorXd>(r_.data() + row, linear);
    p.force = world_.pose(m.a).rotation.conjugate() * Eigen::Vector3d(impulse / time);
    if (block.law.tangents == 3) p.torsion = r_[row + 3] * p.torsion_radius / time;
  }
  std::ranges::sort(state.row_forces, {},
                    [](const RowForce& row) { return std::pair(row.kind, row.index); });
  disengage();
  for (Load& load : state.loads) load = {};
  state.report.contacts = static_cast<int>(touches_.size());
  state.report.max_residual = std::max(state.report.max_residual, state.report.residual);
  ++state.report.steps;
}

// What is welded to something that moves as prescribed moves so, too.
void Stepper::carry_welded() {
  DynamicState& state = world_.edit_dynamics();
  for (const auto& [body, to] : system_.welds) {
    if (system_.place(body).tree >= 0) continue;
    state.twists[body.index] = world_.carried_twist(body, to);
  }
}

void Stepper::solve_found(double h) {
  carry_welded();
  DynamicState& state = world_.edit_dynamics();
  for (const auto id : world_.robots()) pull_tendons(world_, id, h, state);
  state.report.residual = 0;
  // surfaces that lie in each other by no more only touch
  const auto is_inside = [deep = -0.01 * world_.contact_threshold()](const ManifoldPoint& p) {
    return p.gap < deep;
  };
  for (const Manifold& m : state.manifolds)
    state.report.overlaps +=
        m.clearance == 0 && (m.points.empty() || std::ranges::any_of(m.points, is_inside));
  find_free_velocities(h);
  update_manifolds();
  find_rows(h);
  r_.setZero(row_count_);
  find_islands();
  if (world_.dynamic_settings().engine == DynamicsEngine::ode) {
    solve_by_ode(h);
  } else {
    resting_.assign(trees_.size(), false);
    for (const Island& island : islands_) solve_island(island, h);
    apply_impulses(h);
  }
  find_times(h);
  keep();
}

}  // namespace clench
