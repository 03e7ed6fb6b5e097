#include "clench/dynamics/solve/friction_newton.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"

namespace clench {

using Eigen::VectorXd;

double FrictionNewton::classify(const ScaledFriction& problem, const VectorXd& r,
                                const VectorXd& u) {
  double square = 0;
  states_.resize(problem.blocks.size()), slide_.resize(4 * problem.blocks.size());
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    if (block.moves)
      square += natural_map(block, block.d, rho_, &r[block.row], &u[block.row], states_[i],
                            &slide_[4 * i]);
    else
      states_[i] = State::fixed;
  }
  return square / 2;
}

void FrictionNewton::decide(const ScaledFriction& problem, VectorXd& r) {
  directions_.clear();
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    const int row = block.row, tangents = block.tangents;
    if (!block.moves) continue;
    if (states_[i] == State::fixed) {
      r.segment(row, block.size()).setZero();
    } else if (states_[i] == State::low) {
      r[row] = block.low;
    } else if (states_[i] == State::high) {
      r[row] = block.high;
    } else if (states_[i] == State::free) {
      directions_.push_back({.row = row});
    } else if (states_[i] == State::sticks) {
      for (int k = 0; k <= tangents; ++k) directions_.push_back({.row = row + k});
    } else if (block.mu == 0) {
      r.segment(row + 1, tangents).setZero();
      directions_.push_back({.row = row});
    } else {
      const double* t = &slide_[4 * i + 1];
      const double beta = slide_[4 * i];
      Direction normal{.row = row, .tangents = tangents};
      double along = 0;
      for (int k = 0; k < tangents; ++k)
        normal.t[k] = block.mu * t[k], along += t[k] * r[row + 1 + k];
      for (int k = 0; k < tangents; ++k) r[row + 1 + k] += (block.mu * r[row] - along) * t[k];
      directions_.push_back(normal);
      Direction across{.row = row, .tangents = tangents, .across = true, .factor = beta};
      across.diagonal = (1 - beta) * block.d / rho_;
      if (tangents == 2) {
        across.t[0] = -t[1], across.t[1] = t[0];
        directions_.push_back(across);
      } else if (tangents == 3) {
        // two orthogonal directions across it
        const int smallest = std::abs(t[0]) < std::abs(t[1])
                                 ? (std::abs(t[0]) < std::abs(t[2]) ? 0 : 2)
                                 : (std::abs(t[1]) < std::abs(t[2]) ? 1 : 2);
        const Eigen::Vector3d along_t(t[0], t[1], t[2]);
        const Eigen::Vector3d a = along_t.cross(Eigen::Vector3d::Unit(smallest)).normalized(),
                              b = along_t.cross(a);
        for (const auto& direction : {a, b}) {
          for (int k = 0; k < 3; ++k) across.t[k] = direction[k];
          directions_.push_back(across);
        }
      }
    }
  }
}

bool FrictionNewton::factor(const ScaledFriction& problem, double damping) {
  progress_.check();
  const int n = static_cast<int>(directions_.size()), rows = problem.rows();
  Eigen::MatrixXd& m = matrix_;
  m.resize(n, n);
  columns_.resize(rows, 1);
  symmetric_ = true;
  StopCheck check(256);
  for (int l = 0; l < n; ++l) {
    check();
    const Direction& by = directions_[l];
    const double* column = problem.S.col(by.row).data();
    if (by.tangents > 0) {
      // velocities caused by this combination of a contact's rows
      symmetric_ = false;
      if (by.across)
        columns_.col(0).setZero();
      else
        columns_.col(0) = problem.S.col(by.row);
      for (int k = 0; k < by.tangents; ++k)
        columns_.col(0) += by.t[k] * problem.S.col(by.row + 1 + k);
      column = columns_.data();
    }
    double* out = m.col(l).data();
    for (int k = 0; k < n; ++k) {
      const Direction& of = directions_[k];
      if (!of.across) {
        out[k] = column[of.row];
        continue;
      }
      double sum = 0;
      for (int c = 0; c < of.tangents; ++c) sum += of.t[c] * column[of.row + 1 + c];
      out[k] = of.factor * sum;
    }
    out[l] += by.factor * damping * problem.weights[by.row] + by.diagonal;
  }
  factored_ = states_, factored_damping_ = damping;
  if (!symmetric_) {
    lu_.factor(m);
    return true;
  }
  if (cholesky_.factor(m)) return true;
  factored_.clear();
  return false;
}

bool FrictionNewton::step(const ScaledFriction& problem, double damping, const VectorXd& r,
                          const VectorXd& u, bool keep, VectorXd& next) {
  next = r;
  decide(problem, next);
  shift_ = u;
  StopCheck check(256);
  for (int j = 0; j < problem.rows(); ++j) {
    const double change = next[j] - r[j];
    if (change == 0) continue;
    check();
    shift_ += change * problem.S.col(j);
    shift_[j] += change * damping * problem.weights[j];
  }
  const int n = static_cast<int>(directions_.size());
  if (n == 0) return true;
  right_.resize(n);
  for (int k = 0; k < n; ++k) {
    const Direction& of = directions_[k];
    double sum = of.across ? 0 : shift_[of.row];
    if (of.across)
      for (int c = 0; c < of.tangents; ++c)
        sum += of.t[c] * (of.factor * shift_[of.row + 1 + c] + of.diagonal * next[of.row + 1 + c]);
    right_[k] = -sum;
  }
  const bool kept = keep && factored_damping_ == damping && factored_ == states_;
  if (!kept && !factor(problem, damping)) return false;
  along_ = symmetric_ ? cholesky_.solve(right_) : lu_.solve(right_);
  for (int k = 0; k < n; ++k) {
    const Direction& by = directions_[k];
    if (!std::isfinite(along_[k])) return factored_.clear(), false;
    if (!by.across) next[by.row] += along_[k];
    for (int c = 0; c < by.tangents; ++c) next[by.row + 1 + c] += by.t[c] * along_[k];
  }
  return true;
}

bool FrictionNewton::slides() const {
  return std::find(states_.begin(), states_.end(), State::slides) != states_.end();
}

FrictionNewton::End FrictionNewton::solve(const ScaledFriction& problem, const VectorXd& q,
                                          double damping, double rho, int max_iterations,
                                          VectorXd& r) {
  rho_ = rho;
  End end;
  const auto velocities = [&](const VectorXd& at, VectorXd& u) {
    check_stop();
    u = q + damping * problem.weights.cwiseProduct(at);
    u.noalias() += problem.S * at;
  };
  velocities(r, u_);
  double merit = classify(problem, r, u_), best = merit;
  best_ = r;
  int climbs = 0;
  while (end.iterations < max_iterations) {
    ++end.iterations;
    if (!step(problem, damping, r, u_, false, next_)) break;
    const std::vector<State> before = states_;
    double length = (next_ - r).lpNorm<Eigen::Infinity>();
    const double size = next_.lpNorm<Eigen::Infinity>();
    velocities(next_, u_next_);
    double next_merit = classify(problem, next_, u_next_);
    const bool linear = states_ == before && !slides();
    // with sliding, the size of the next step is about the square of this one's
    const double size_of_all = size + q.lpNorm<Eigen::Infinity>();
    const bool near = length <= 1e-5 * size && std::sqrt(next_merit) <= 1e-12 * size_of_all;
    if (std::isfinite(next_merit) && (linear || near)) {
      r.swap(next_);
      end.converged = true;
      return end;
    }
    // shorter steps while the full one increases the residual
    double fraction = 1;
    if (!(next_merit < merit * (1 - 1e-4))) {
      right_ = next_;
      VectorXd tried = next_;
      double lowest = next_merit, best_fraction = 1;
      for (int i = 0; i < 3; ++i) {
        fraction /= 2;
        tried = r + fraction * (right_ - r);
        velocities(tried, u_next_);
        const double value = classify(problem, tried, u_next_);
        if (value < lowest || !std::isfinite(lowest)) lowest = value, best_fraction = fraction;
        if (value < merit * (1 - 1e-4 * fraction)) break;
      }
      if (!(lowest < merit)) {
        if (++climbs > 3) break;
        best_fraction = 1;
      }
      if (best_fraction != fraction) {
        tried = r + best_fraction * (right_ - r);
        velocities(tried, u_next_);
        next_merit = classify(problem, tried, u_next_);
      } else {
        next_merit = lowest;
      }
      next_ = tried;
    }
    if (!std::isfinite(next_merit)) break;
    r.swap(next_), u_.swap(u_next_);
    merit = next_merit;
    if (merit < best) best = merit, best_ = r;
  }
  r = best_;
  return end;
}

bool FrictionNewton::refine(const ScaledFriction& problem, double damping, const VectorXd& u,
                            VectorXd& r) {
  rho_ = 1;
  classify(problem, r, u);
  if (!step(problem, damping, r, u, true, next_)) return false;
  r.swap(next_);
  return true;
}

}  // namespace clench
