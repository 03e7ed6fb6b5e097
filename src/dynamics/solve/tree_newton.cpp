#include "clench/dynamics/solve/tree_newton.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"

namespace clench {

using Eigen::VectorXd;

void TreeNewton::set(const TreeFriction& problem) {
  std::vector<int> sizes;
  for (int t = 0; t < problem.trees(); ++t) sizes.push_back(problem.size(t));
  std::vector<std::pair<int, int>> pairs;
  for (const auto& block : problem.blocks)
    if (block.sides[0].tree >= 0 && block.sides[1].tree >= 0)
      pairs.emplace_back(std::minmax(block.sides[0].tree, block.sides[1].tree));
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  system_.analyze(sizes, pairs);
  places_.clear();
  for (const auto& block : problem.blocks) {
    auto& places = places_.emplace_back();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const int a = block.sides[i].tree, b = block.sides[j].tree;
        places[2 * i + j] = a >= 0 && b >= 0 ? system_.place(a, b) : -1;
      }
  }
}

// Sets the states of all blocks at impulses r with velocities u.
// returns  half the squared norm of the natural map, weighted by d
double TreeNewton::classify(const TreeFriction& problem, const VectorXd& r, const VectorXd& u,
                            double rho) {
  rho_ = rho;
  states_.resize(problem.blocks.size()), slide_.resize(4 * problem.blocks.size());
  double energy = 0;
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    if (block.moves)
      energy += block.d * natural_map(block, block.d, rho, &r[block.row], &u[block.row], states_[i],
                                      &slide_[4 * i]);
    else
      states_[i] = State::fixed;
  }
  return energy / 2;
}

// Unit directions across t.   returns  their number: one for two tangents, two for three
static int across(int tangents, const double* t, double directions[2][3]) {
  if (tangents < 2) return 0;
  if (tangents == 2) {
    directions[0][0] = -t[1], directions[0][1] = t[0];
    return 1;
  }
  const int smallest = std::abs(t[0]) < std::abs(t[1]) ? (std::abs(t[0]) < std::abs(t[2]) ? 0 : 2)
                                                       : (std::abs(t[1]) < std::abs(t[2]) ? 1 : 2);
  const Eigen::Vector3d along(t[0], t[1], t[2]);
  const Eigen::Vector3d a = along.cross(Eigen::Vector3d::Unit(smallest)).normalized(),
                        b = along.cross(a);
  for (int k = 0; k < 3; ++k) directions[0][k] = a[k], directions[1][k] = b[k];
  return 2;
}

// Computes the law of a block from its state: the state fixes some directions of r, and each of the
// others has one equation.
void TreeNewton::find_law(const TreeFriction::Block& block, size_t number, double damping,
                          const double* r, const double* u, Law& law) const {
  const int size = block.size();
  const double by = damping * block.weight;
  std::fill(law.G, law.G + size * size, 0.0);
  switch (states_[number]) {
    case State::fixed:
      for (int k = 0; k < size; ++k) law.change[k] = block.moves ? -r[k] : 0;
      return;
    case State::low:
      law.change[0] = block.low - r[0];
      return;
    case State::high:
      law.change[0] = block.high - r[0];
      return;
    case State::free:
      law.G[0] = 1 / (by + block.compliance);
      law.change[0] = -law.G[0] * u[0];
      return;
    case State::sticks:
      for (int k = 0; k < size; ++k) law.G[(size + 1) * k] = 1 / by, law.change[k] = -u[k] / by;
      return;
    case State::slides:
      return find_sliding_law(block, number, by, r, u, law);
  }
}

void TreeNewton::find_sliding_law(const TreeFriction::Block& block, size_t number, double by,
                                  const double* r, const double* u, Law& law) const {
  const int size = block.size();
  const double beta = slide_[4 * number], *t = &slide_[4 * number + 1];
  // friction is proportional to the normal impulse
  double along = 0;
  for (int k = 0; k < block.tangents; ++k) along += t[k] * r[1 + k];
  law.G[0] = 1 / by;
  law.change[0] = -u[0] / by;
  for (int k = 0; k < block.tangents; ++k) {
    law.G[1 + k] = block.mu * t[k] / by;
    law.change[1 + k] = (block.mu * r[0] - along) * t[k] - block.mu * t[k] * u[0] / by;
  }
  if (block.mu == 0)
    for (int k = 0; k < block.tangents; ++k) law.change[1 + k] = -r[1 + k];
  double directions[2][3];
  const int count = block.mu > 0 ? across(block.tangents, t, directions) : 0;
  for (int c = 0; c < count; ++c) {
    const double* a = directions[c];
    const double diagonal = (1 - beta) * block.d / rho_, stiffness = 1 / (beta * by + diagonal);
    double slip = 0, friction = 0;
    for (int k = 0; k < block.tangents; ++k) slip += a[k] * u[1 + k], friction += a[k] * r[1 + k];
    const double x = -stiffness * (beta * slip + diagonal * friction);
    for (int k = 0; k < block.tangents; ++k) {
      law.change[1 + k] += x * a[k];
      for (int l = 0; l < block.tangents; ++l)
        law.G[size * (1 + l) + 1 + k] += beta * stiffness * a[k] * a[l];
    }
  }
}

namespace {

// B += left G right^T, all by columns; left: n x size, right: m x size
template <int N, int M, int Size>
void add_triple(const double* left, const double* G, const double* right, double* B) {
  using Eigen::Map;
  using Eigen::Matrix;
  const Matrix<double, N, Size> scaled = Map<const Matrix<double, N, Size>>(left).lazyProduct(
      Map<const Matrix<double, Size, Size>>(G));
  Map<Matrix<double, N, M>>(B).noalias() +=
      scaled.lazyProduct(Map<const Matrix<double, M, Size>>(right).transpose());
}

void add_triple(int n, int m, int size, const double* left, const double* G, const double* right,
                double* B) {
  for (int k = 0; k < size; ++k)
    for (int l = 0; l < size; ++l) {
      const double g = G[size * l + k];
      if (g == 0) continue;
      for (int j = 0; j < m; ++j) {
        const double x = g * right[m * l + j];
        for (int i = 0; i < n; ++i) B[n * j + i] += x * left[n * k + i];
      }
    }
}

}  // namespace

void TreeNewton::add_to_system(const TreeFriction& problem, const TreeFriction::Block& block,
                               size_t number) {
  const State state = states_[number];
  if (state == State::fixed || state == State::low || state == State::high) return;
  const double* G = laws_[number].G;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const int place = places_[number][2 * i + j];
      if (place < 0) continue;
      const auto &a = block.sides[i], &b = block.sides[j];
      const double *left = problem.columns.data() + a.at, *right = problem.columns.data() + b.at;
      double* to = system_.values() + place;
      const int n = problem.size(a.tree), m = problem.size(b.tree);
      if (n == 6 && m == 6 && block.size() == 3)
        add_triple<6, 6, 3>(left, G, right, to);
      else
        add_triple(n, m, block.size(), left, G, right, to);
    }
}

// One Newton step from r, after visit() has set the states there.   u  velocities at r, with the
// damping
bool TreeNewton::step(const TreeFriction& problem, double damping, const VectorXd& r,
                      const VectorXd& u, VectorXd& next) {
  laws_.resize(problem.blocks.size());
  system_.set_zero();
  for (int t = 0; t < problem.trees(); ++t) {
    const int n = problem.size(t);
    double* diagonal = system_.values() + system_.place(t, t);
    for (int k = 0; k < n; ++k) diagonal[(n + 1) * k] = 1;
  }
  motion_.setZero(problem.first.back());
  StopCheck check(64);
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    check();
    const auto& block = problem.blocks[i];
    find_law(block, i, damping, &r[block.row], &u[block.row], laws_[i]);
    problem.add_motion(block, laws_[i].change, motion_);
    add_to_system(problem, block, i);
  }
  if (!system_.factor()) return false;
  system_.solve(motion_);
  next = r;
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    const Law& law = laws_[i];
    double by_motion[4] = {};
    problem.add_velocity(block, motion_, by_motion);
    const int size = block.size();
    for (int k = 0; k < size; ++k) {
      double sum = law.change[k];
      for (int l = 0; l < size; ++l) sum -= law.G[size * l + k] * by_motion[l];
      next[block.row + k] += sum;
    }
  }
  return next.allFinite();
}

bool TreeNewton::slides() const {
  return std::ranges::find(states_, State::slides) != states_.end();
}

// Returns half the squared norm of the natural map at r, with the damping; sets states and u.
double TreeNewton::visit(const TreeFriction& problem, const Pull& pull, const VectorXd& r,
                         VectorXd& u) {
  check_stop();
  problem.move(r, motion_);
  problem.velocities(r, motion_, u);
  for (const auto& block : problem.blocks) {
    const double by = pull.damping * block.weight;
    for (int k = block.row; k < block.row + block.size(); ++k) u[k] += by * (r[k] - pull.center[k]);
  }
  return classify(problem, r, u, pull.rho);
}

// Line search for a step to `next_` that does not reduce the energy: tries a half, a quarter and an
// eighth of it.   returns  the energy at the best of them
double TreeNewton::shorten(const TreeFriction& problem, const Pull& pull, double energy,
                           double next_energy, const VectorXd& r) {
  full_ = next_;
  double lowest = next_energy, best = 1, fraction = 1, last = 1;
  for (int i = 0; i < 3; ++i) {
    last = fraction /= 2;
    next_ = r + fraction * (full_ - r);
    const double value = visit(problem, pull, next_, u_next_);
    if (value < lowest || !std::isfinite(lowest)) lowest = value, best = fraction;
    if (value < energy * (1 - 1e-4 * fraction)) break;
  }
  // no part reduces the energy: take the full step, to leave the neighborhood
  if (!(lowest < energy)) best = 1;
  if (best == last) return lowest;
  next_ = r + best * (full_ - r);
  return visit(problem, pull, next_, u_next_);
}

TreeNewton::End TreeNewton::solve(const TreeFriction& problem, const Pull& pull, double enough,
                                  int max_iterations, VectorXd& r) {
  constexpr int max_climbs = 3;
  End end;
  double energy = visit(problem, pull, r, u_), least = energy;
  const double aim = enough * enough * energy;
  best_ = r;
  for (int climbs = 0; end.iterations < max_iterations;) {
    ++end.iterations;
    if (!step(problem, pull.damping, r, u_, next_)) break;
    const std::vector<State> before = states_;
    double next_energy = visit(problem, pull, next_, u_next_);
    const bool linear = states_ == before && !slides();
    if (std::isfinite(next_energy) && (linear || next_energy <= aim)) {
      r.swap(next_);
      end.converged = true;
      return end;
    }
    if (!(next_energy < energy * (1 - 1e-4))) {
      next_energy = shorten(problem, pull, energy, next_energy, r);
      if (!(next_energy < energy) && ++climbs > max_climbs) break;
    }
    if (!std::isfinite(next_energy)) break;
    r.swap(next_), u_.swap(u_next_);
    energy = next_energy;
    if (energy < least) least = energy, best_ = r;
  }
  r = best_;
  return end;
}

bool TreeNewton::refine(const TreeFriction& problem, double damping, VectorXd& r) {
  visit(problem, {.damping = damping, .center = r}, r, u_);
  if (!step(problem, damping, r, u_, next_)) return false;
  r.swap(next_);
  return true;
}

}  // namespace clench
