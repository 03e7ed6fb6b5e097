// FrictionNewton::follow: continuation from the solution of a nearby problem, state by state.
#include <algorithm>
#include <cmath>
#include <limits>

#include "clench/base/watched.h"
#include "clench/dynamics/solve/friction_newton.h"

namespace clench {

using Eigen::VectorXd;

namespace {

// a path that turns back for longer than this seldom recovers
constexpr int max_back = 6;
constexpr double never = std::numeric_limits<double>::infinity();

// the first alpha >= 0 at which |t + alpha dt| - mu (n + alpha dn) changes to the sign given
double meets_cone(double mu, int tangents, const double* z, const double* by, double sign) {
  double a = -mu * mu * by[0] * by[0], b = -mu * mu * z[0] * by[0], c = -mu * mu * z[0] * z[0];
  for (int k = 1; k <= tangents; ++k) a += by[k] * by[k], b += z[k] * by[k], c += z[k] * z[k];
  a *= sign, b *= sign, c *= sign;
  // it is at or beyond the boundary: does it move on outwards?
  if (c >= 0) {
    if (b > 0) return 0;
    c = 0;
  }
  // a alpha^2 + 2 b alpha + c increases through 0, c <= 0
  const double root = b * b - a * c;
  if (root < 0) return never;
  const double alpha = b > 0    ? -c / (b + std::sqrt(root))
                       : a != 0 ? (std::sqrt(root) - b) / a
                                : never;
  return alpha >= 0 ? alpha : never;
}

}  // namespace

void FrictionNewton::begin_path(const ScaledFriction& problem, const VectorXd& r,
                                const VectorXd& u) {
  states_.resize(problem.blocks.size()), slide_.resize(4 * problem.blocks.size());
  z_ = r;
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    const auto& block = problem.blocks[i];
    const int row = block.row;
    if (!block.moves) {
      states_[i] = State::fixed;
    } else if (!block.is_contact()) {
      states_[i] = r[row] <= block.low    ? State::low
                   : r[row] >= block.high ? State::high
                                          : State::free;
      if (states_[i] == State::low) z_[row] = block.low - std::max(u[row], 0.0) / block.d;
      if (states_[i] == State::high) z_[row] = block.high - std::min(u[row], 0.0) / block.d;
    } else if (!(r[row] > 0)) {
      states_[i] = State::fixed;
      z_.segment(row, block.size()) = -u.segment(row, block.size()) / block.d;
      if (z_[row] > 0) states_[i] = State::slides;
      double square = 0;
      for (int k = 1; k <= block.tangents; ++k) square += z_[row + k] * z_[row + k];
      if (z_[row] > 0 && block.mu > 0 && std::sqrt(square) <= block.mu * z_[row])
        states_[i] = State::sticks;
    } else {
      double length = 0, along = 0;
      for (int k = 1; k <= block.tangents; ++k)
        length += r[row + k] * r[row + k], along += r[row + k] * u[row + k];
      length = std::sqrt(length);
      states_[i] =
          block.mu > 0 && length < block.mu * r[row] * (1 - 1e-9) ? State::sticks : State::slides;
      if (block.mu == 0)
        z_.segment(row + 1, block.tangents) = -u.segment(row + 1, block.tangents) / block.d;
      if (states_[i] == State::sticks || block.mu == 0) continue;
      // just on the cone or beyond
      if (block.tangents == 0) {
        states_[i] = State::sticks;
        continue;
      }
      const double scale =
          block.mu * r[row] / length + std::max(-along / length, 0.0) / (block.d * length);
      for (int k = 1; k <= block.tangents; ++k) z_[row + k] = scale * r[row + k];
    }
  }
}

void FrictionNewton::find_slides(const ScaledFriction& problem) {
  for (size_t i = 0; i < problem.blocks.size(); ++i) {
    if (states_[i] != State::slides) continue;
    const auto& block = problem.blocks[i];
    double* t = &slide_[4 * i + 1];
    double length = 0;
    for (int k = 0; k < block.tangents; ++k) t[k] = z_[block.row + 1 + k], length += t[k] * t[k];
    length = std::sqrt(length);
    slide_[4 * i] =
        length > 0 ? std::min(block.mu * std::max(z_[block.row], 0.0) / length, 1.0) : 0;
    for (int k = 0; k < block.tangents && length > 0; ++k) t[k] /= length;
  }
}

double FrictionNewton::leaves(const ScaledFriction::ScaledBlock& block, State state,
                              const double* z, const double* by, double most, State& next) const {
  double alpha = most;
  const auto leaves_at = [&](double value, double change, State other) {
    // value + alpha change falls below 0
    if (!(change < 0)) return;
    const double at = std::max(value, 0.0) / -change;
    if (at < alpha) alpha = at, next = other;
  };
  if (!block.is_contact()) {
    if (state == State::low) leaves_at(block.low - z[0], -by[0], State::free);
    if (state == State::high) leaves_at(z[0] - block.high, by[0], State::free);
    if (state == State::free)
      leaves_at(z[0] - block.low, by[0], State::low),
          leaves_at(block.high - z[0], -by[0], State::high);
    return alpha;
  }
  const bool frictional = block.mu > 0 && block.tangents > 0;
  if (state == State::fixed) {
    leaves_at(-z[0], -by[0], block.mu > 0 && block.tangents == 0 ? State::sticks : State::slides);
    return alpha;
  }
  if (frictional) {
    const double at = meets_cone(block.mu, block.tangents, z, by, state == State::sticks ? 1 : -1);
    if (at < alpha) alpha = at, next = state == State::sticks ? State::slides : State::sticks;
  }
  leaves_at(z[0], by[0], State::fixed);
  return alpha;
}

FrictionNewton::End FrictionNewton::follow(const ScaledFriction& problem, const VectorXd& q,
                                           double damping, int max_iterations, VectorXd& r) {
  rho_ = 1;
  End end;
  const auto velocities = [&](const VectorXd& at, VectorXd& u) {
    check_stop();
    u = q + damping * problem.weights.cwiseProduct(at);
    u.noalias() += problem.S * at;
  };
  best_ = r;
  velocities(best_, u_);
  begin_path(problem, best_, u_);
  int changed = -1, back = 0;
  double sense = 1;
  while (end.iterations < max_iterations) {
    ++end.iterations;
    find_slides(problem);
    if (!step(problem, damping, best_, u_, false, next_)) break;
    velocities(next_, u_next_);
    change_ = next_ - z_;
    for (const auto& block : problem.blocks)
      for (int k = 0; k < block.size(); ++k)
        change_[block.row + k] -= u_next_[block.row + k] / block.d;
    best_.swap(next_), u_.swap(u_next_);
    if (!change_.allFinite()) break;
    change_ *= sense;
    State into = State::fixed, of = State::fixed;
    // a path that turned back follows q in the opposite direction for a while
    if (changed >= 0) {
      const auto& block = problem.blocks[changed];
      if (leaves(block, states_[changed], &z_[block.row], &change_[block.row], 1e-14, into) == 0)
        sense = -sense, change_ = -change_;
    }
    if (sense < 0 && ++back > max_back) break;
    double alpha = sense > 0 ? 1 : 1e6;
    int blocking = -1;
    for (size_t i = 0; i < problem.blocks.size(); ++i) {
      const auto& block = problem.blocks[i];
      if (!block.moves) continue;
      const double at = leaves(block, states_[i], &z_[block.row], &change_[block.row], alpha, of);
      if (!(at < alpha) || (static_cast<int>(i) == changed && at == 0)) continue;
      alpha = at, blocking = static_cast<int>(i), into = of;
    }
    z_ += alpha * change_;
    changed = blocking;
    if (blocking >= 0) {
      states_[blocking] = into;
      continue;
    }
    if (sense < 0) break;
    const double size = best_.lpNorm<Eigen::Infinity>();
    if (!slides() || change_.lpNorm<Eigen::Infinity>() <= 1e-6 * size) {
      end.converged = true;
      r = best_;
      return end;
    }
  }
  return end;
}

}  // namespace clench
