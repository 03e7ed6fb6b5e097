// Stepper::solve: forces, contacts, limits and motors give new velocities.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "clench/contact/cone.h"
#include "clench/dynamics/solve/friction_residual.h"
#include "clench/dynamics/stepper.h"
#include "clench/model/near_bodies.h"

namespace clench {

// Surfaces that move faster than this along each other when a step begins have kinetic friction [m/s].
static constexpr double sliding_speed = 1e-6;
// Faults of a solution [m/s].
static constexpr double tolerance = 1e-12;
// What touches, is slower than this and would gain no more than that in a step under the forces that it had rests: it stops, and
// its forces stay. In a step of 1 ms that is a millionth of gravity [m/s, rad/s].
static constexpr double rest_speed = 1e-7, rest_tolerance = 1e-8;
// A gap this near to that at which bodies rest, as a part of the contact threshold, is that one.
static constexpr double rest_band = 1e-3;
// Of a gap below that at which bodies rest, this part is opened in a step, but not faster than so [m/s].
static constexpr double pushed_part = 0.2, pushed_at_most = 0.1;
// Below this speed of approach nothing bounces [m/s].
static constexpr double bounces_above = 0.01;

Vector6d Stepper::root_twist(int tree) const {
  const Articulation& articulation = system_.trees[tree];
  Vector6d out = Vector6d::Zero();
  if (articulation.floating) return out;
  // about() is the root's centre of mass
  const Twist twist = world_.twist(articulation.root);
  out << twist.linear, twist.angular;
  return out;
}

Eigen::Vector3d Stepper::told_velocity(Id<Body> id, const Eigen::Vector3d& p_W) const {
  Eigen::Vector3d out = Eigen::Vector3d::Zero();
  const System::Place place = system_.place(id);
  const Body& body = world_.body(id);
  const Pose& X_WB = world_.pose(id);
  if (place.tree < 0) {
    const Twist twist = world_.twist(id);
    out = twist.linear + twist.angular.cross(p_W - X_WB * body.com);
  } else if (!system_.trees[place.tree].floating) {
    const Vector6d twist = root_twist(place.tree);
    const Eigen::Vector3d turning = twist.tail<3>();
    out = twist.head<3>() + turning.cross(p_W - trees_[place.tree].about());
  }
  const auto& belts = world_.dynamic_settings().surface_velocities;
  if (const auto belt = belts.find(id); belt != belts.end()) out += X_WB.rotation * belt->second;
  return out;
}

void Stepper::find_free_velocities(double h) {
  const DynamicState& state = *world_.dynamics();
  gather_velocities(system_, state, v_);
  v_before_ = v_;
  for (size_t t = 0; t < trees_.size(); ++t) {
    const Articulation& tree = system_.trees[t];
    TreeDynamics& dynamics = trees_[t];
    const int n = tree.size();
    if (n == 0) continue;
    dynamics.place(world_, tree);
    Eigen::VectorXd efforts = -dynamics.find_bias(v_, root_twist(static_cast<int>(t)), world_.gravity());
    find_joint_forces(world_, tree, h, state, forces_[t]);
    efforts += forces_[t].efforts;
    for (size_t i = 0; i < tree.coordinates.size(); ++i)
      efforts[tree.root_size() + static_cast<int>(i)] += told_effort(world_, tree.coordinates[i], state);
    for (size_t b = 0; b < tree.bodies.size(); ++b) {
      const Load& load = state.loads[tree.bodies[b].body.index];
      if (load.force.isZero(0) && load.torque.isZero(0)) continue;
      const int body = static_cast<int>(b);
      for (int k = 0; k < 3; ++k) {
        dynamics.add_linear(body, dynamics.com(body), Eigen::Vector3d::Unit(k), load.force[k], efforts);
        dynamics.add_angular(body, Eigen::Vector3d::Unit(k), load.torque[k], efforts);
      }
    }
    auto v = v_.segment(tree.first, n);
    dynamics.factor(forces_[t].added);
    Eigen::VectorXd rhs = h * efforts - forces_[t].velocity_part.cwiseProduct(v);
    if (!tree.floating) {
      Vector6d told;
      told << state.told[tree.root.index].linear, state.told[tree.root.index].angular;
      rhs += dynamics.jerk(root_twist(static_cast<int>(t)) - told);
    }
    dynamics.half_solve(rhs);
    dynamics.other_half_solve(rhs);
    v += rhs;
  }
}

void Stepper::update_manifolds() {
  const double threshold = world_.contact_threshold();
  for (Manifold& m : world_.edit_dynamics().manifolds) {
    const double moved = displacement(m.X_AB, relative_pose(world_, m.a, m.b), *world_.body(m.b).shape);
    if (m.clear > threshold ? moved >= m.clear - threshold : moved > follows_within * threshold)
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

void Stepper::add_contact(int manifold, int point, double h) {
  const Manifold& m = world_.dynamics()->manifolds[manifold];
  const ManifoldPoint& p = m.points[point];
  const Body &a = world_.body(m.a), &b = world_.body(m.b);
  const Pose &X_WA = world_.pose(m.a), &X_WB = world_.pose(m.b);
  const Eigen::Vector3d normal = (X_WA.rotation * p.normal).normalized();
  const Eigen::Matrix3d xyz = contact_frame(normal);
  Touch touch{.manifold = manifold, .point = point, .frame = {}, .p_W = 0.5 * (X_WA * p.p_a + X_WB * p.p_b), .a = m.a, .b = m.b};
  touch.frame << normal, xyz.col(0), xyz.col(1);
  const Friction friction = world_.materials().friction(a.material, b.material);
  Block block;
  block.touch = static_cast<int>(touches_.size());
  block.law.row = row_count_;
  block.law.tangents = friction.statics > 0 ? (p.torsion_radius > 0 ? 3 : 2) : 0;
  const int size = block.law.size();

  const std::array<Id<Body>, 2> bodies = {m.a, m.b};
  Eigen::Vector3d told = told_velocity(m.b, touch.p_W) - told_velocity(m.a, touch.p_W);
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
        trees_[place.tree].add_angular(place.body, normal, sign * p.torsion_radius, column);
    }
  }
  // the gap may close as far as bodies rest, in the step to come
  const double step = world_.dynamic_settings().step, beyond = p.gap - rest_gap * world_.contact_threshold();
  double target = std::abs(beyond) <= rest_band * world_.contact_threshold() ? 0 : beyond > 0 ? -beyond / step : std::min(-pushed_part * beyond / step, pushed_at_most);
  const double restitution = friction.restitution.value_or(std::max(a.restitution, b.restitution));
  double slip = 0;
  for (int k = 0; k < size; ++k) {
    double q = k < 3 ? touch.frame.col(k).dot(told) : 0, before = q;
    for (int side = 0; side < 2; ++side)
      if (const int t = block.tree[side]; t >= 0) {
        const auto column = tree_rows_[t].Y.col(block.column[side] + k);
        q += column.dot(v_.segment(system_.trees[t].first, system_.trees[t].size()));
        before += column.dot(v_before_.segment(system_.trees[t].first, system_.trees[t].size()));
      }
    // Newton's law of impact, where the free motion would press
    if (k == 0 && q < target && before < -bounces_above) target = std::max(target, -restitution * before);
    if (k == 0) q -= target;
    if (k > 0) slip += before * before;
    q_.conservativeResize(row_count_ + k + 1);
    q_[row_count_ + k] = q;
  }
  block.law.mu = slip > sliding_speed * sliding_speed ? friction.kinetic : friction.statics;
  // warm start
  const Eigen::Vector3d force = X_WA.rotation * p.force;
  for (int k = 0; k < size; ++k) warm_.push_back(h * (k < 3 ? touch.frame.col(k).dot(force) : p.torsion / p.torsion_radius));
  row_count_ += size;
  touch.target = target;
  touches_.push_back(touch);
  blocks_.push_back(block);
}

void Stepper::add_row(int number) {
  const CoordinateRow& row = coordinate_rows_[number];
  Block block;
  block.row = number;
  block.law = {.row = row_count_, .low = row.low, .high = row.high};
  block.tree[0] = row.tree;
  block.column[0] = add_columns(row.tree, 1);
  tree_rows_[row.tree].Y(row.coordinate, block.column[0]) = 1;
  q_.conservativeResize(row_count_ + 1);
  q_[row_count_] = v_[system_.trees[row.tree].first + row.coordinate] - row.target;
  double warm = 0;
  for (const RowImpulse& last : world_.dynamics()->impulses)
    if (last.kind == static_cast<int>(row.kind) && last.index == row.index) warm = last.impulse;
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
  q_.resize(0);
  for (TreeRows& rows : tree_rows_) rows.rows.clear();
  for (size_t m = 0; m < state.manifolds.size(); ++m)
    for (size_t p = 0; p < state.manifolds[m].points.size(); ++p)
      if (state.manifolds[m].points[p].gap <= world_.contact_threshold())
        add_contact(static_cast<int>(m), static_cast<int>(p), h);
  for (size_t t = 0; t < trees_.size(); ++t)
    add_coordinate_rows(world_, system_.trees[t], static_cast<int>(t), trees_[t].mass_matrix(), h, state, coordinate_rows_);
  for (size_t i = 0; i < coordinate_rows_.size(); ++i) add_row(static_cast<int>(i));
  compliance_.setZero(row_count_);
  for (const Block& block : blocks_)
    if (block.row >= 0) compliance_[block.law.row] = coordinate_rows_[block.row].compliance;
  for (size_t t = 0; t < trees_.size(); ++t)
    if (const auto count = static_cast<Eigen::Index>(tree_rows_[t].rows.size()); count > 0)
      trees_[t].half_solve(tree_rows_[t].Y.leftCols(count));
}

// Blocks that share a tree, straight or through others.
std::vector<std::vector<int>> Stepper::find_islands() const {
  std::vector<int> leader(trees_.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  for (const Block& block : blocks_)
    if (block.tree[0] >= 0 && block.tree[1] >= 0) {
      const int a = find(block.tree[0]), b = find(block.tree[1]);
      leader[std::max(a, b)] = std::min(a, b);
    }
  std::vector<int> island_of(trees_.size(), -1);
  std::vector<std::vector<int>> islands;
  for (size_t i = 0; i < blocks_.size(); ++i) {
    const int tree = blocks_[i].tree[0] >= 0 ? blocks_[i].tree[0] : blocks_[i].tree[1];
    if (tree < 0) continue;
    int& island = island_of[find(tree)];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[island].push_back(static_cast<int>(i));
  }
  return islands;
}

// Do the forces of the last step hold what rests? Answered by the velocities that they leave, without the matrix of the problem.
bool Stepper::holds(const std::vector<int>& local, const Eigen::VectorXd& warm, FrictionSolution& solution) {
  const Eigen::Index count = warm.size();
  // of the matrix its diagonal is enough
  if (problem_.W.rows() != count) problem_.W.resize(count, count);
  solution.u = problem_.q;
  for (int row = 0; row < row_count_; ++row) {
    if (local[row] < 0) continue;
    problem_.W(local[row], local[row]) = compliance_[row];
    solution.u[local[row]] += compliance_[row] * warm[local[row]];
  }
  Eigen::VectorXd change;
  for (const TreeRows& rows : tree_rows_) {
    if (rows.rows.empty() || local[rows.rows[0]] < 0) continue;
    change.setZero(rows.Y.rows());
    for (size_t i = 0; i < rows.rows.size(); ++i) {
      const auto column = rows.Y.col(static_cast<Eigen::Index>(i));
      const int k = local[rows.rows[i]];
      change += warm[k] * column;
      problem_.W(k, k) += column.squaredNorm();
    }
    for (size_t i = 0; i < rows.rows.size(); ++i)
      solution.u[local[rows.rows[i]]] += rows.Y.col(static_cast<Eigen::Index>(i)).dot(change);
  }
  const FrictionFault fault = friction_fault(problem_, warm, solution.u, rest_tolerance);
  solution.r = warm;
  solution.residual = fault.largest;
  solution.solved = fault.excess <= 1;
  return solution.solved;
}

void Stepper::assemble(const std::vector<int>& local, int count) {
  problem_.W.setZero(count, count);
  for (int row = 0; row < row_count_; ++row)
    if (local[row] >= 0) problem_.W(local[row], local[row]) = compliance_[row];
  for (const TreeRows& rows : tree_rows_) {
    const int columns = static_cast<int>(rows.rows.size());
    if (columns == 0 || local[rows.rows[0]] < 0) continue;
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j <= i; ++j) {
        const double w = rows.Y.col(i).dot(rows.Y.col(j));
        const int a = local[rows.rows[i]], b = local[rows.rows[j]];
        problem_.W(a, b) += w;
        if (i != j) problem_.W(b, a) += w;
      }
  }
}

void Stepper::solve_island(const std::vector<int>& blocks) {
  std::vector<int> local(row_count_, -1);
  problem_.blocks.clear();
  int count = 0;
  for (const int i : blocks) {
    FrictionProblem::Block law = blocks_[i].law;
    for (int k = 0; k < law.size(); ++k) local[law.row + k] = count + k;
    law.row = count;
    count += law.size();
    problem_.blocks.push_back(law);
  }
  // what rests keeps the forces that it has as long as they hold it
  bool at_rest = true;
  for (const int i : blocks)
    for (const int t : blocks_[i].tree)
      at_rest = at_rest && (t < 0 || v_before_.segment(system_.trees[t].first, system_.trees[t].size()).cwiseAbs().maxCoeff() < rest_speed);
  problem_.q.resize(count);
  Eigen::VectorXd warm(count);
  for (int row = 0; row < row_count_; ++row) {
    if (local[row] < 0) continue;
    problem_.q[local[row]] = q_[row];
    warm[local[row]] = warm_[row];
  }
  const DynamicSettings& settings = world_.dynamic_settings();
  FrictionSolution solution;
  const bool held = at_rest && settings.cone == FrictionCone::cone && holds(local, warm, solution);
  if (!held) {
    assemble(local, count);
    solution = solver_.solve(
        problem_, warm, {.cone = settings.cone, .edges = settings.cone_edges, .tolerance = 1, .speed = at_rest ? rest_tolerance : tolerance});
  }
  for (int row = 0; row < row_count_; ++row) {
    if (local[row] < 0) continue;
    r_[row] = solution.r[local[row]];
    u_[row] = solution.u[local[row]];
  }
  if (at_rest && solution.iterations == 0)
    for (const int i : blocks)
      for (const int t : blocks_[i].tree)
        if (t >= 0) resting_[t] = true;
  StepReport& report = world_.edit_dynamics().report;
  report.iterations += solution.iterations;
  report.fallbacks += solution.fell_back;
  report.failures += !solution.solved;
  report.residual = std::max(report.residual, solution.residual);
}

void Stepper::apply_impulses() {
  for (size_t t = 0; t < trees_.size(); ++t) {
    const TreeRows& rows = tree_rows_[t];
    if (rows.rows.empty()) continue;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(system_.trees[t].size());
    for (size_t i = 0; i < rows.rows.size(); ++i) change += r_[rows.rows[i]] * rows.Y.col(static_cast<Eigen::Index>(i));
    trees_[t].other_half_solve(change);
    auto v = v_.segment(system_.trees[t].first, system_.trees[t].size());
    v += change;
    if (resting_[t] && v.cwiseAbs().maxCoeff() < rest_speed) v.setZero();
  }
}

// What the next step, and whoever looks, wants of this one.
void Stepper::keep(double h) {
  DynamicState& state = world_.edit_dynamics();
  scatter_velocities(system_, world_, v_, state);
  for (size_t t = 0; t < trees_.size(); ++t) {
    const Articulation& tree = system_.trees[t];
    const Vector6d root = root_twist(static_cast<int>(t));
    if (!tree.floating) state.told[tree.root.index] = world_.twist(tree.root);
    if (tree.joints.empty() || tree.size() == 0) continue;
    for (size_t b = 0; b < tree.bodies.size(); ++b)
      if (tree.bodies[b].body != tree.root)
        state.twists[tree.bodies[b].body.index] =
            trees_[t].twist(static_cast<int>(b), v_.segment(tree.first, tree.size()), root);
  }
  for (Manifold& m : state.manifolds)
    for (ManifoldPoint& p : m.points) p.force.setZero(), p.torsion = 0;
  state.impulses.clear();
  for (const Block& block : blocks_) {
    const int row = block.law.row;
    if (block.row >= 0) {
      const CoordinateRow& c = coordinate_rows_[block.row];
      state.impulses.push_back({static_cast<int>(c.kind), c.index, r_[row]});
      if (c.kind == RowKind::motor) state.dof_efforts[c.index] = r_[row] / h + state.controls[c.index].effort;
      continue;
    }
    const Touch& touch = touches_[block.touch];
    Manifold& m = state.manifolds[touch.manifold];
    ManifoldPoint& p = m.points[touch.point];
    const int linear = std::min(block.law.size(), 3);
    const Eigen::Vector3d impulse = touch.frame.leftCols(linear) * Eigen::Map<const Eigen::VectorXd>(r_.data() + row, linear);
    p.force = world_.pose(m.a).rotation.conjugate() * Eigen::Vector3d(impulse / h);
    if (block.law.tangents == 3) p.torsion = r_[row + 3] * p.torsion_radius / h;
  }
  disengage(h);
  for (Load& load : state.loads) load = {};
  state.report.contacts = static_cast<int>(touches_.size());
  state.report.largest_residual = std::max(state.report.largest_residual, state.report.residual);
  ++state.report.steps;
}

// A joint of a breakaway DOF leaves it when more is asked of it, in the sense in which the DOF closes, than its clutch gives;
// the last one that follows stays.
void Stepper::disengage(double h) {
  DynamicState& state = world_.edit_dynamics();
  for (size_t t = 0; t < trees_.size(); ++t) {
    const Articulation& tree = system_.trees[t];
    const auto may_leave = [&](const TreeJoint& joint) {
      const Robot& robot = world_.robot(joint.robot);
      const DofSpec& dof = robot.dofs[robot.joints[joint.joint].dof];
      return dof.kind == DofKind::breakaway && dof.breakaway_torque > 0 && world_.follows_dof(joint.robot, joint.joint);
    };
    if (std::ranges::none_of(tree.joints, may_leave)) continue;
    std::vector<Vector6d> loads(tree.bodies.size(), Vector6d::Zero());
    const auto add = [&](Id<Body> id, const Eigen::Vector3d& p_W, const Eigen::Vector3d& force, const Eigen::Vector3d& torque) {
      const System::Place place = system_.place(id);
      if (place.tree != static_cast<int>(t)) return;
      loads[place.body].head<3>() += force;
      loads[place.body].tail<3>() += torque + (p_W - trees_[t].about()).cross(force);
    };
    for (const Touch& touch : touches_) {
      const Manifold& m = state.manifolds[touch.manifold];
      const ManifoldPoint& p = m.points[touch.point];
      const Eigen::Vector3d force = world_.pose(m.a).rotation * p.force, torque = p.torsion * touch.frame.col(0);
      add(m.a, touch.p_W, -force, -torque);
      add(m.b, touch.p_W, force, torque);
    }
    for (size_t b = 0; b < tree.bodies.size(); ++b) {
      const Load& load = state.loads[tree.bodies[b].body.index];
      add(tree.bodies[b].body, trees_[t].com(static_cast<int>(b)), load.force, load.torque);
    }
    const auto& efforts = trees_[t].inverse_dynamics(v_before_, (v_ - v_before_) / h, root_twist(static_cast<int>(t)),
                                                     world_.gravity(), loads);
    for (size_t i = 0; i < tree.joints.size(); ++i) {
      const TreeJoint& joint = tree.joints[i];
      if (!may_leave(joint)) continue;
      const Robot& robot = world_.robot(joint.robot);
      const Joint& spec = robot.joints[joint.joint];
      const DofSpec& dof = robot.dofs[spec.dof];
      const double closing = dof.default_velocity < 0 ? -1 : 1;
      if (closing * (spec.ratio < 0 ? -efforts[i] : efforts[i]) <= dof.breakaway_torque) continue;
      int following = 0;
      for (size_t j = 0; j < robot.joints.size(); ++j)
        following += robot.joints[j].dof == spec.dof && world_.follows_dof(joint.robot, static_cast<int>(j));
      if (following > 1) world_.set_follows_dof(joint.robot, joint.joint, false);
    }
  }
}

void Stepper::solve(double h) {
  refresh();
  DynamicState& state = world_.edit_dynamics();
  find_manifolds(world_, system_, 0);
  for (const auto id : world_.robots()) pull_tendons(world_, id, h, state);
  state.report.residual = 0;
  for (const Manifold& m : state.manifolds) state.report.overlaps += m.clear == 0;
  find_free_velocities(h);
  update_manifolds();
  find_rows(h);
  r_.setZero(row_count_);
  u_ = q_;
  if (world_.dynamic_settings().engine == DynamicsEngine::ode) {
    solve_by_ode(h);
  } else {
    resting_.assign(trees_.size(), false);
  for (const auto& island : find_islands()) solve_island(island);
    apply_impulses();
  }
  keep(h);
}

}  // namespace clench
