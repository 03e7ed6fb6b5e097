#include "clench/grasp/wrench/slice.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "clench/base/random.h"
#include "clench/base/watched.h"

namespace clench {

namespace {

constexpr double away_from_faces = 1e-11;
// gains below this end the iteration
constexpr double worth_a_step = 1e-12;
constexpr double smallest_pivot = 1e-9;
// far more than programs of four rows need
constexpr int max_pivots = 500;

}  // namespace

Slice::Slice(const SupportSet& set, const Eigen::VectorXd& values)
    : set_(set), fixed_(static_cast<int>(values.size())) {
  const int d = set.dimension(), rows = fixed_ + 1;
  free_ = d - fixed_;
  Random random(1);
  expected_.resize(rows);
  for (int i = 0; i < fixed_; ++i)
    expected_[i] = values[i] + away_from_faces * random.uniform(-1, 1);
  expected_[fixed_] = 1;

  // artificial points that form the first basis, a simplex around the values, and must leave it
  corners_ = Eigen::MatrixXd::Zero(d, rows);
  for (int k = 0; k < rows; ++k) {
    corners_.col(k).tail(fixed_) = expected_.head(fixed_);
    if (k < fixed_)
      corners_(free_ + k, k) += 1;
    else
      corners_.col(k).tail(fixed_).array() -= 1;
  }
  // their weights are equal: e_1 + ... + e_m - (1, ..., 1) = 0
  weights_ = Eigen::VectorXd::Constant(rows, 1.0 / rows);
  // columns (v + e_k; 1) and (v - 1; 1): the inverse is (e_k . (x - v) + 1) / rows plus a term for
  // the sum
  Eigen::MatrixXd inverse(rows, rows);
  for (int column = 0; column < rows; ++column) {
    // weights whose combination is the column'th unit vector: x - v t, with t its last number
    Eigen::VectorXd x = Eigen::VectorXd::Unit(rows, column);
    const double t = x[fixed_];
    const Eigen::VectorXd y = x.head(fixed_) - t * expected_.head(fixed_);
    const double last = (t - y.sum()) / rows;
    for (int k = 0; k < fixed_; ++k) inverse(k, column) = y[k] + last;
    inverse(fixed_, column) = last;
  }
  inverse_ = inverse;
  stands_in_.assign(rows, 1);

  climb(Eigen::VectorXd::Zero(d), -1);
  for (int k = 0; k < rows; ++k)
    if (stands_in_[k] && weights_[k] > 1e-9) empty_ = true;
  if (empty_) return;
  // an artificial point with zero weight is replaced by any point that can enter
  for (int k = 0; k < rows; ++k)
    for (int side = 0; side < 2 && stands_in_[k]; ++side) {
      Eigen::VectorXd way = Eigen::VectorXd::Zero(d), point(d);
      way.tail(fixed_) = (side ? -1 : 1) * inverse_.row(k).head(fixed_).transpose();
      set_.support(way.data(), point.data());
      const Eigen::VectorXd shares = shares_of(point);
      if (std::abs(shares[k]) > smallest_pivot) enter(point, shares, k);
    }
}

Eigen::VectorXd Slice::shares_of(const Eigen::VectorXd& point) const {
  Eigen::VectorXd column(fixed_ + 1);
  column << point.tail(fixed_), 1;
  return inverse_ * column;
}

// index of the first weight to become zero when the new point's weight increases; -1: none
int Slice::leaving(const Eigen::VectorXd& shares) const {
  int first = -1;
  double least = 0;
  for (int k = 0; k <= fixed_; ++k) {
    if (shares[k] <= smallest_pivot) continue;
    const double ratio = std::max(0.0, weights_[k]) / shares[k];
    // among equals the artificial point, then the largest pivot
    const bool better = first < 0 || ratio < least - 1e-15 ||
                        (ratio <= least + 1e-15 &&
                         (stands_in_[k] > stands_in_[first] ||
                          (stands_in_[k] == stands_in_[first] && shares[k] > shares[first])));
    if (better) first = k, least = ratio;
  }
  return first;
}

void Slice::enter(const Eigen::VectorXd& point, const Eigen::VectorXd& shares, int out) const {
  corners_.col(out) = point;
  stands_in_[out] = 0;
  const Eigen::RowVectorXd row = inverse_.row(out) / shares[out];
  for (int k = 0; k <= fixed_; ++k)
    if (k != out) inverse_.row(k) -= shares[k] * row;
  inverse_.row(out) = row;
  // one Newton step prevents rounding errors from accumulating
  Eigen::MatrixXd basis(fixed_ + 1, fixed_ + 1);
  basis << corners_.bottomRows(fixed_), Eigen::RowVectorXd::Ones(fixed_ + 1);
  inverse_ = (2 * inverse_ - inverse_ * basis * inverse_).eval();
  weights_ = inverse_ * expected_;
}

double Slice::climb(const Eigen::VectorXd& goal, double stand_in) const {
  const int rows = fixed_ + 1;
  Eigen::VectorXd worth(rows), way(set_.dimension()), point(set_.dimension());
  for (int pivot = 0; pivot < max_pivots; ++pivot) {
    check_stop();
    for (int k = 0; k < rows; ++k) worth[k] = stands_in_[k] ? stand_in : goal.dot(corners_.col(k));
    // price that a point must exceed to improve the goal: prices of the fixed coordinates and of
    // weight
    const Eigen::VectorXd prices = inverse_.transpose() * worth;
    way = goal;
    way.tail(fixed_) -= prices.head(fixed_);
    const double reach = set_.support(way.data(), point.data());
    if (reach - prices[fixed_] <= worth_a_step) break;
    const Eigen::VectorXd shares = shares_of(point);
    const int out = leaving(shares);
    if (out < 0) break;
    enter(point, shares, out);
  }
  double sum = 0;
  for (int k = 0; k < rows; ++k)
    sum += weights_[k] * (stands_in_[k] ? stand_in : goal.dot(corners_.col(k)));
  return sum;
}

double Slice::support(const double* direction, double* point) const {
  Eigen::VectorXd goal = Eigen::VectorXd::Zero(set_.dimension());
  goal.head(free_) = Eigen::Map<const Eigen::VectorXd>(direction, free_);
  climb(goal, 0);
  const Eigen::VectorXd at = corners_.topRows(free_) * weights_;
  std::copy_n(at.data(), free_, point);
  return goal.head(free_).dot(at);
}

}  // namespace clench
