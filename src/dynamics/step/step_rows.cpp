#include "clench/dynamics/step/step_rows.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/contact/cone.h"
#include "clench/dynamics/contact/manifolds.h"
#include "clench/dynamics/contact/rolling.h"
#include "clench/dynamics/control/tendon_rows.h"
#include "clench/dynamics/step/islands.h"
#include "clench/dynamics/step/prescribed.h"

namespace clench {
namespace {

// Surfaces whose relative sliding speed at the start of a step exceeds this have kinetic friction
// [m/s], if it also exceeds the speed that gravity adds in a step: a body that comes to rest after
// a tiny fall sticks.
constexpr double sliding_speed = 1e-3;
// Gaps within this fraction of the contact threshold below the rest gap count as the rest gap: so
// the points of a pair that has come to rest have no target velocity and share its force; the
// smallest difference between their targets would put all of it on a few points.
constexpr double rest_band = 1e-3;
// This fraction of the missing rest gap is opened per step, at most at this speed [m/s]: slowly
// enough that bodies that are pushed apart press on each other as if at rest.
constexpr double pushed_part = 0.02, max_push = 0.1;
// Bodies that turn while they slide come closer; they are pushed apart by more, up to a fraction of
// the sliding speed.
constexpr double pushed_part_sliding = 0.5, pushed_of_slip = 0.1;
// Bodies that approach each other faster than the first collide; below the second, nothing bounces
// [m/s].
constexpr double meeting_speed = 1e-6, min_bounce_speed = 0.01;
// A contact is blocked if every coordinate moves its point at right angles to the normal, within
// this angle [rad]: effective masses along it are only rounding errors. Contacts that all
// coordinates move within the other angle are pushed apart more slowly, as little of their motion
// opens the gap.
constexpr double blocked_angle = 1e-6, narrow_angle = 0.1;

class RowBuilder {
 public:
  RowBuilder(const World& world, const System& system, StepProblem& problem)
      : world_(world), system_(system), state_(*world.dynamics()), problem_(problem) {}

  void add_contacts();
  void add_coordinate_rows_of_trees();
  void half_solve();

 private:
  int add_columns(int tree, int count);
  Eigen::Matrix3d frame_of(const Manifold& m, int manifold, const ManifoldPoint& p) const;
  void add_contact(int manifold, int point);
  double mobility(const TouchingPoint& touch) const;
  void add_contact_columns(const TouchingPoint& touch, StepBlock& block);
  std::array<double, 4> add_free_velocities(const TouchingPoint& touch, const StepBlock& block);
  void add_row(int number);
  Eigen::Index first(int tree) const { return system_.trees[tree].first; }
  Eigen::Index size(int tree) const { return system_.trees[tree].size(); }

  const World& world_;
  const System& system_;
  const DynamicState& state_;
  StepProblem& problem_;
};

// Columns of zeros for the next rows of the step.
int RowBuilder::add_columns(int tree, int count) {
  TreeColumns& columns = problem_.columns[tree];
  const int first = static_cast<int>(columns.rows.size());
  const int needed = first + count;
  if (columns.Y.rows() != size(tree) || columns.Y.cols() < needed)
    columns.Y.conservativeResize(size(tree), std::max(2 * needed, 16));
  columns.Y.middleCols(first, count).setZero();
  for (int k = 0; k < count; ++k) columns.rows.push_back(problem_.rows() + k);
  return first;
}

// The normal and two tangents, as columns. Points with equal normals share their frame.
Eigen::Matrix3d RowBuilder::frame_of(const Manifold& m, int manifold,
                                     const ManifoldPoint& p) const {
  const TouchingPoint* last = problem_.touches.empty() ? nullptr : &problem_.touches.back();
  if (last && last->manifold == manifold && m.points[last->point].normal == p.normal)
    return last->frame;
  const Eigen::Vector3d normal = (world_.pose(m.a).rotation * p.normal).normalized();
  const Eigen::Matrix3d xyz = contact_frame(normal);
  Eigen::Matrix3d frame;
  frame << normal, xyz.col(0), xyz.col(1);
  return frame;
}

// How well coordinates move b's point relative to a's along the normal: the largest sine, over all
// coordinates, of the angle between the point's motion and the tangent plane. 1 for free bodies; 0
// if nothing moves.
double RowBuilder::mobility(const TouchingPoint& touch) const {
  constexpr double at_axis = 1e-12;  // points this near to a joint's axis do not move [m/rad]
  const System::Place a = system_.place(touch.a), b = system_.place(touch.b);
  for (const int tree : {a.tree, b.tree})
    if (tree >= 0 && system_.trees[tree].size() > 0 && system_.trees[tree].floating) return 1;
  double most = 0;
  for (const int tree : {a.tree, b.tree}) {
    if (tree < 0 || system_.trees[tree].size() == 0) continue;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size(tree), 3);
    for (int k = 0; k < 3; ++k) {
      const auto& dynamics = problem_.trees[tree];
      if (a.tree == tree) dynamics.add_linear(a.body, touch.p_W, touch.frame.col(k), -1, J.col(k));
      if (b.tree == tree) dynamics.add_linear(b.body, touch.p_W, touch.frame.col(k), 1, J.col(k));
    }
    for (Eigen::Index c = 0; c < J.rows(); ++c)
      if (const double speed = J.row(c).norm(); speed > at_axis)
        most = std::max(most, std::abs(J(c, 0)) / speed);
  }
  return most;
}

// Motion of the point that each tree causes, on b relative to a.
void RowBuilder::add_contact_columns(const TouchingPoint& touch, StepBlock& block) {
  const std::array<Id<Body>, 2> bodies = {touch.a, touch.b};
  const Eigen::Vector3d normal = touch.frame.col(0);
  const int size = block.law.size();
  for (int side = 0; side < 2; ++side) {
    const System::Place place = system_.place(bodies[side]);
    if (place.tree < 0 || system_.trees[place.tree].size() == 0) continue;
    const bool same = side == 1 && block.tree[0] == place.tree;
    const int slot = same ? 0 : side;
    block.tree[slot] = place.tree;
    if (!same) block.column[slot] = add_columns(place.tree, size);
    const double sign = side == 0 ? -1 : 1;
    for (int k = 0; k < size; ++k) {
      auto column = problem_.columns[place.tree].Y.col(block.column[slot] + k);
      if (k < 3)
        problem_.trees[place.tree].add_linear(place.body, touch.p_W, touch.frame.col(k), sign,
                                              column);
      else
        problem_.trees[place.tree].add_angular(place.body, normal, sign * touch.torsion_radius,
                                               column);
    }
  }
}

// Adds the velocities of the contact's rows without contacts to q.
// returns  those at the start of the step
std::array<double, 4> RowBuilder::add_free_velocities(const TouchingPoint& touch,
                                                      const StepBlock& block) {
  const auto prescribed = [&](Id<Body> body) {
    return prescribed_velocity(world_, system_, problem_.trees, body, touch.p_W);
  };
  const auto turning = [&](Id<Body> body) {
    return prescribed_angular_velocity(world_, system_, body);
  };
  const Eigen::Vector3d relative = prescribed(touch.b) - prescribed(touch.a) + touch.belt_W;
  std::array<double, 4> before = {};
  for (int k = 0; k < block.law.size(); ++k) {
    double q =
        k < 3 ? touch.frame.col(k).dot(relative)
              : touch.torsion_radius * touch.frame.col(0).dot(turning(touch.b) - turning(touch.a));
    before[k] = q;
    for (int side = 0; side < 2; ++side)
      if (const int t = block.tree[side]; t >= 0) {
        const auto column = problem_.columns[t].Y.col(block.column[side] + k);
        q += column.dot(problem_.v_free.segment(first(t), size(t)));
        before[k] += column.dot(problem_.v_before.segment(first(t), size(t)));
      }
    problem_.q.push_back(q);
  }
  return before;
}

void RowBuilder::add_contact(int manifold, int point) {
  const Manifold& m = state_.manifolds[manifold];
  const ManifoldPoint& p = m.points[point];
  const Body &a = world_.body(m.a), &b = world_.body(m.b);
  const Pose &X_WA = world_.pose(m.a), &X_WB = world_.pose(m.b);
  TouchingPoint touch{.manifold = manifold,
                      .point = point,
                      .a = m.a,
                      .b = m.b,
                      .p_W = 0.5 * (X_WA * p.p_a + X_WB * p.p_b),
                      .frame = frame_of(m, manifold, p),
                      .torsion_radius = p.torsion_radius};
  const double moves = mobility(touch);
  if (moves < blocked_angle) {
    problem_.touches.push_back(touch);
    return;
  }
  // a surface that runs along itself
  const Eigen::Vector3d normal = touch.frame.col(0),
                        belt = belt_velocity(world_, touch.b) - belt_velocity(world_, touch.a);
  touch.belt_W = belt - belt.dot(normal) * normal;
  const Friction friction = world_.materials().friction(a.material, b.material);
  StepBlock block;
  block.touch = static_cast<int>(problem_.touches.size());
  block.law.row = problem_.rows();
  block.law.pair = manifold;
  block.law.tangents = friction.statics > 0 ? (p.torsion_radius > 0 ? 3 : 2) : 0;
  const int size = block.law.size();
  add_contact_columns(touch, block);
  const std::array<double, 4> before = add_free_velocities(touch, block);

  // touching bodies come no closer, and bodies that are too close separate
  const double h = problem_.h, step = std::max(world_.dynamic_settings().step, h);
  const double threshold = world_.contact_threshold();
  const double missing =
      p.gap < (rest_gap - rest_band) * threshold ? rest_gap * threshold - p.gap : 0;
  double slip = 0;
  for (int k = 1; k < size; ++k) slip += before[k] * before[k];
  slip = std::sqrt(slip);
  const bool slides = slip > std::max(sliding_speed, world_.gravity().norm() * step);
  block.law.mu = slides ? friction.kinetic : friction.statics;
  double target = pushed_part * missing / step;
  if (slides)
    target =
        std::max(target, std::min(pushed_part_sliding * missing / step, pushed_of_slip * slip));
  target = std::min(target, max_push) * std::min(1.0, moves / narrow_angle);
  // a rolling body keeps moving over its surface; above the rest gap it may approach at its present
  // speed, and it is lifted by no more than the rest gap in a step, as more would add energy
  const double rolled = rolled_gap(world_, m, p, step), rest = rest_gap * threshold;
  target -= std::clamp(rolled, -rest, std::max(p.gap - rest, 0.0)) / step;
  // Newton's law of impact, if the free motion would press. Bodies move with the velocity that they
  // had at the start of the step: a body accelerated by gravity or a motor arrives too fast by half
  // of the velocity gained in a step, and would bounce too far accordingly
  const double restitution = friction.restitution.value_or(std::max(a.restitution, b.restitution));
  double& q_normal = problem_.q[block.law.row];
  if (q_normal < target && before[0] < -min_bounce_speed) {
    const double gain = std::max((before[0] - q_normal) / h, 0.0) * step;
    target = std::max(target, -restitution * q_normal - (1 + restitution) / 2 * gain);
  }
  block.approaches = before[0] < -meeting_speed;
  q_normal -= target;
  const Eigen::Vector3d force = X_WA.rotation * p.force;
  for (int k = 0; k < size; ++k)
    problem_.warm_start.push_back(
        h * (k < 3 ? touch.frame.col(k).dot(force) : p.torsion / p.torsion_radius));
  problem_.push.push_back(target);
  problem_.push.resize(problem_.q.size(), 0);
  touch.target = target;
  problem_.touches.push_back(touch);
  problem_.blocks.push_back(block);
}

void RowBuilder::add_contacts() {
  for (size_t m = 0; m < state_.manifolds.size(); ++m) {
    check_stop();
    for (size_t p = 0; p < state_.manifolds[m].points.size(); ++p)
      if (state_.manifolds[m].points[p].gap <= world_.contact_threshold())
        add_contact(static_cast<int>(m), static_cast<int>(p));
  }
}

void RowBuilder::add_row(int number) {
  const CoordinateRow& row = problem_.coordinate_rows[number];
  StepBlock block;
  block.coordinate_row = number;
  block.law = {.row = problem_.rows(), .low = row.low, .high = row.high};
  block.tree[0] = row.tree;
  block.column[0] = add_columns(row.tree, 1);
  auto column = problem_.columns[row.tree].Y.col(block.column[0]);
  const auto v = problem_.v_free.segment(first(row.tree), size(row.tree));
  if (row.arms.empty()) {
    column[row.coordinate] = 1;
    problem_.q.push_back(v[row.coordinate] - row.target);
  } else {
    double velocity = 0;
    for (const auto& [coordinate, arm] : row.arms) {
      column[coordinate] = arm;
      velocity += arm * v[coordinate];
    }
    problem_.q.push_back(velocity - row.target);
  }
  double warm = 0;
  const auto key = [](const RowForce& last) { return std::pair(last.kind, last.index); };
  const std::pair wanted(row.kind, row.index);
  const auto& all = state_.row_forces;
  if (const auto last = std::ranges::lower_bound(all, wanted, {}, key);
      last != all.end() && key(*last) == wanted)
    warm = problem_.h * last->force;
  problem_.warm_start.push_back(std::clamp(warm, row.low, row.high));
  // an exceeded limit adds a velocity that corrects it
  const bool lower = row.kind == RowKind::low_limit || row.kind == RowKind::tendon_low;
  const bool upper = row.kind == RowKind::high_limit || row.kind == RowKind::tendon_high;
  problem_.push.push_back((lower && row.target > 0) || (upper && row.target < 0) ? row.target : 0);
  problem_.blocks.push_back(block);
}

void RowBuilder::add_coordinate_rows_of_trees() {
  for (size_t t = 0; t < system_.trees.size(); ++t) {
    check_stop();
    const Articulation& tree = system_.trees[t];
    const int number = static_cast<int>(t);
    add_free_friction_rows(world_, tree, number, problem_.h, problem_.coordinate_rows);
    if (tree.coordinates.empty()) continue;
    Eigen::MatrixXd mass = problem_.trees[t].mass_matrix();
    mass.diagonal() += problem_.forces[t].added - problem_.forces[t].velocity_part;
    add_coordinate_rows(world_, tree, number, mass, problem_.h, state_, problem_.coordinate_rows);
    add_tendon_rows(world_, tree, number, problem_.h, state_, problem_.coordinate_rows);
  }
  for (size_t i = 0; i < problem_.coordinate_rows.size(); ++i) add_row(static_cast<int>(i));
}

// J^T becomes Y = L^-1 J^T.
void RowBuilder::half_solve() {
  for (size_t t = 0; t < system_.trees.size(); ++t)
    if (const auto count = static_cast<Eigen::Index>(problem_.columns[t].rows.size()); count > 0)
      problem_.trees[t].half_solve(problem_.columns[t].Y.leftCols(count));
}

// If bodies collide at the end of a shortened step, their impulse, and that of all bodies that
// touch them, is not treated as a force over that short duration.
void find_times(const World& world, StepProblem& problem) {
  const double h = problem.h, whole = std::max(h, world.dynamics()->whole_step);
  problem.tree_times.assign(problem.trees.size(), h);
  for (StepBlock& block : problem.blocks) block.time = h;
  if (h == whole) return;
  for (const Island& island : problem.islands) {
    if (std::ranges::none_of(island.blocks, [&](int i) { return problem.blocks[i].approaches; }))
      continue;
    for (const int i : island.blocks) problem.blocks[i].time = whole;
    for (const int t : island.trees) problem.tree_times[t] = whole;
  }
}

}  // namespace

void find_rows(const World& world, const System& system, StepProblem& problem) {
  problem.touches.clear();
  problem.coordinate_rows.clear();
  problem.blocks.clear();
  problem.q.clear();
  problem.push.clear();
  problem.warm_start.clear();
  problem.columns.resize(system.trees.size());
  for (TreeColumns& columns : problem.columns) columns.rows.clear();
  RowBuilder builder(world, system, problem);
  builder.add_contacts();
  builder.add_coordinate_rows_of_trees();
  builder.half_solve();
  problem.compliance.assign(problem.q.size(), 0);
  for (const StepBlock& block : problem.blocks)
    if (block.coordinate_row >= 0)
      problem.compliance[block.law.row] = problem.coordinate_rows[block.coordinate_row].compliance;
  find_islands(problem);
  find_times(world, problem);
}

}  // namespace clench
