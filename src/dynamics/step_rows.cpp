// Stepper: contacts, limits and motors as rows of a friction problem.
#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"
#include "clench/contact/cone.h"
#include "clench/dynamics/control/tendon_rows.h"
#include "clench/dynamics/stepper.h"
#include "clench/model/near_bodies.h"

namespace clench {

// Surfaces that move faster than this along each other when a step begins have kinetic friction
// [m/s], if it is also faster than gravity makes them in a step: a body that comes to rest from
// next to no height sticks.
static constexpr double sliding_speed = 1e-3;
// A gap this near to that at which bodies rest, as a part of the contact threshold, is that one: so
// points of a pair that has come to rest ask for nothing, and share its force, where the least
// difference between what they ask would put all of it on a few.
static constexpr double rest_band = 1e-3;
// Of a gap below that at which bodies rest, this part is opened in a step, but not faster than so
// [m/s]: so slowly that what is pushed apart presses on each other as if it rested.
static constexpr double pushed_part = 0.02, pushed_at_most = 0.1;
// What turns while it slides comes nearer as it does; it is pushed apart by more, up to a part of
// the speed of sliding.
static constexpr double pushed_part_sliding = 0.5, pushed_of_slip = 0.1;
// From this speed of approach on bodies meet, and below that one nothing bounces [m/s].
static constexpr double meeting_speed = 1e-6;
static constexpr double bounces_above = 0.01;

Eigen::Vector3d Stepper::prescribed_velocity(Id<Body> id, const Eigen::Vector3d& p_W) const {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  const System::Place place = system_.place(id);
  const Body& body = world_.body(id);
  const Pose& X_WB = world_.pose(id);
  if (place.tree < 0) {
    const Twist twist = world_.twist(id);
    if (!twist.is_zero()) out = twist.linear + twist.angular.cross(p_W - X_WB * body.com);
  } else if (!system_.trees[place.tree].floating) {
    const Vector6d twist = root_twist(place.tree);
    const Eigen::Vector3d turning = twist.tail<3>();
    out = twist.head<3>() + turning.cross(p_W - trees_[place.tree].about());
  }
  return out;
}

Eigen::Vector3d Stepper::prescribed_turning(Id<Body> id) const {
  const System::Place place = system_.place(id);
  if (place.tree < 0) return world_.twist(id).angular;
  if (system_.trees[place.tree].floating) return Eigen::Vector3d::Zero();
  return root_twist(place.tree).tail<3>();
}

// how its surface runs over it, as that of a conveyor belt [m/s]
Eigen::Vector3d Stepper::surface_velocity(Id<Body> id) const {
  const auto& belts = world_.dynamic_settings().surface_velocities;
  const auto belt = belts.find(id);
  return belt != belts.end() ? world_.pose(id).rotation * belt->second : Eigen::Vector3d::Zero();
}

void Stepper::update_manifolds() {
  const double threshold = world_.contact_threshold();
  for (Manifold& m : world_.edit_dynamics().manifolds) {
    const double moved =
        displacement(m.X_AB, relative_pose(world_, m.a, m.b), *world_.body(m.b).shape);
    if (m.clearance > threshold ? moved >= m.clearance - threshold
                                : moved > follows_within * threshold)
      measure(world_, m);
    else
      update_gaps(world_, m);
    for (ManifoldPoint& point : m.points) update_torsion(point);
  }
}

int Stepper::add_columns(int tree, int count) {
  TreeRows& rows = tree_rows_[tree];
  const int first = static_cast<int>(rows.rows.size());
  const int needed = first + count;
  if (rows.Y.rows() != system_.trees[tree].size() || rows.Y.cols() < needed)
    rows.Y.conservativeResize(system_.trees[tree].size(), std::max(2 * needed, 16));
  rows.Y.middleCols(first, count).setZero();
  for (int k = 0; k < count; ++k) rows.rows.push_back(row_count_ + k);
  return first;
}

// The normal and two tangents, as columns; points of one normal have one.
Eigen::Matrix3d Stepper::frame_of(const Manifold& m, int manifold, const ManifoldPoint& p) const {
  const TouchingPoint* last = touches_.empty() ? nullptr : &touches_.back();
  if (last && last->manifold == manifold && m.points[last->point].normal == p.normal)
    return last->frame;
  const Eigen::Vector3d normal = (world_.pose(m.a).rotation * p.normal).normalized();
  const Eigen::Matrix3d xyz = contact_frame(normal);
  Eigen::Matrix3d frame;
  frame << normal, xyz.col(0), xyz.col(1);
  return frame;
}

// How each tree moves the point, b's against a's: columns of its rows.
void Stepper::add_contact_columns(const TouchingPoint& touch, double torsion_radius,
                                  PlacedBlock& block) {
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
      auto column = tree_rows_[place.tree].Y.col(block.column[slot] + k);
      if (k < 3)
        trees_[place.tree].add_linear(place.body, touch.p_W, touch.frame.col(k), sign, column);
      else
        trees_[place.tree].add_angular(place.body, normal, sign * torsion_radius, column);
    }
  }
}

// Velocities of the contact's rows when the step begins; those without contacts are added to q_.
std::array<double, 4> Stepper::add_free_velocities(const TouchingPoint& touch,
                                                   double torsion_radius,
                                                   const PlacedBlock& block) {
  // a surface runs along itself
  const Eigen::Vector3d normal = touch.frame.col(0),
                        belt = surface_velocity(touch.b) - surface_velocity(touch.a);
  const Eigen::Vector3d prescribed = prescribed_velocity(touch.b, touch.p_W) -
                                     prescribed_velocity(touch.a, touch.p_W) + belt -
                                     belt.dot(normal) * normal;
  std::array<double, 4> before = {};
  for (int k = 0; k < block.law.size(); ++k) {
    double q = k < 3 ? touch.frame.col(k).dot(prescribed)
                     : torsion_radius *
                           normal.dot(prescribed_turning(touch.b) - prescribed_turning(touch.a));
    before[k] = q;
    for (int side = 0; side < 2; ++side)
      if (const int t = block.tree[side]; t >= 0) {
        const auto column = tree_rows_[t].Y.col(block.column[side] + k);
        q += column.dot(v_.segment(system_.trees[t].first, system_.trees[t].size()));
        before[k] += column.dot(v_before_.segment(system_.trees[t].first, system_.trees[t].size()));
      }
    q_.push_back(q);
  }
  return before;
}

void Stepper::add_contact(int manifold, int point, double h) {
  const Manifold& m = world_.dynamics()->manifolds[manifold];
  const ManifoldPoint& p = m.points[point];
  const Body &a = world_.body(m.a), &b = world_.body(m.b);
  const Pose &X_WA = world_.pose(m.a), &X_WB = world_.pose(m.b);
  TouchingPoint touch{.manifold = manifold,
                      .point = point,
                      .frame = frame_of(m, manifold, p),
                      .p_W = 0.5 * (X_WA * p.p_a + X_WB * p.p_b),
                      .a = m.a,
                      .b = m.b};
  const Friction friction = world_.materials().friction(a.material, b.material);
  PlacedBlock block;
  block.touch = static_cast<int>(touches_.size());
  block.law.row = row_count_;
  block.law.pair = manifold;
  block.law.tangents = friction.statics > 0 ? (p.torsion_radius > 0 ? 3 : 2) : 0;
  const int size = block.law.size();
  add_contact_columns(touch, p.torsion_radius, block);
  const std::array<double, 4> before = add_free_velocities(touch, p.torsion_radius, block);

  // what touches comes no nearer, and what is too near parts
  const double step = std::max(world_.dynamic_settings().step, h);
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
  target = std::min(target, pushed_at_most);
  // Newton's law of impact, where the free motion would press. Bodies move with the velocity that
  // they had when a step began: what gravity or a motor draws together comes by half a step's gain
  // too fast, and would go by as much too far
  const double restitution = friction.restitution.value_or(std::max(a.restitution, b.restitution));
  double& q_normal = q_[block.law.row];
  if (q_normal < target && before[0] < -bounces_above) {
    const double gain = std::max((before[0] - q_normal) / h, 0.0) * step;
    target = std::max(target, -restitution * q_normal - (1 + restitution) / 2 * gain);
  }
  block.meets = before[0] < -meeting_speed;
  q_normal -= target;
  // warm start
  const Eigen::Vector3d force = X_WA.rotation * p.force;
  for (int k = 0; k < size; ++k)
    warm_.push_back(h * (k < 3 ? touch.frame.col(k).dot(force) : p.torsion / p.torsion_radius));
  row_count_ += size;
  touch.target = target;
  touches_.push_back(touch);
  blocks_.push_back(block);
}

void Stepper::add_row(int number, double h) {
  const CoordinateRow& row = coordinate_rows_[number];
  PlacedBlock block;
  block.row = number;
  block.law = {.row = row_count_, .low = row.low, .high = row.high};
  block.tree[0] = row.tree;
  block.column[0] = add_columns(row.tree, 1);
  const int first = system_.trees[row.tree].first;
  if (row.arms.empty()) {
    tree_rows_[row.tree].Y(row.coordinate, block.column[0]) = 1;
    q_.push_back(v_[first + row.coordinate] - row.target);
  } else {
    double velocity = 0;
    for (const auto& [coordinate, arm] : row.arms) {
      tree_rows_[row.tree].Y(coordinate, block.column[0]) = arm;
      velocity += arm * v_[first + coordinate];
    }
    q_.push_back(velocity - row.target);
  }
  double warm = 0;
  const auto key = [](const RowForce& last) { return std::pair(last.kind, last.index); };
  const std::pair wanted(row.kind, row.index);
  const auto& all = world_.dynamics()->row_forces;
  if (const auto last = std::ranges::lower_bound(all, wanted, {}, key);
      last != all.end() && key(*last) == wanted)
    warm = h * last->force;
  warm_.push_back(std::clamp(warm, row.low, row.high));
  ++row_count_;
  blocks_.push_back(block);
}

void Stepper::find_rows(double h) {
  DynamicState& state = world_.edit_dynamics();
  row_count_ = 0;
  touches_.clear();
  blocks_.clear();
  warm_.clear();
  coordinate_rows_.clear();
  q_.clear();
  for (TreeRows& rows : tree_rows_) rows.rows.clear();
  for (size_t m = 0; m < state.manifolds.size(); ++m) {
    check_stop();
    for (size_t p = 0; p < state.manifolds[m].points.size(); ++p)
      if (state.manifolds[m].points[p].gap <= world_.contact_threshold())
        add_contact(static_cast<int>(m), static_cast<int>(p), h);
  }
  for (size_t t = 0; t < trees_.size(); ++t) {
    check_stop();
    add_free_friction_rows(world_, system_.trees[t], static_cast<int>(t), h, coordinate_rows_);
    if (system_.trees[t].coordinates.empty()) continue;
    Eigen::MatrixXd mass = trees_[t].mass_matrix();
    mass.diagonal() += forces_[t].added - forces_[t].velocity_part;
    add_coordinate_rows(world_, system_.trees[t], static_cast<int>(t), mass, h, state,
                        coordinate_rows_);
    add_tendon_rows(world_, system_.trees[t], static_cast<int>(t), h, state, coordinate_rows_);
  }
  for (size_t i = 0; i < coordinate_rows_.size(); ++i) add_row(static_cast<int>(i), h);
  compliance_.setZero(row_count_);
  local_.resize(row_count_);
  for (const PlacedBlock& block : blocks_)
    if (block.row >= 0) compliance_[block.law.row] = coordinate_rows_[block.row].compliance;
  for (size_t t = 0; t < trees_.size(); ++t)
    if (const auto count = static_cast<Eigen::Index>(tree_rows_[t].rows.size()); count > 0)
      trees_[t].half_solve(tree_rows_[t].Y.leftCols(count));
}

}  // namespace clench
