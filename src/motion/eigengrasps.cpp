#include "clench/motion/eigengrasps.h"

#include <algorithm>

#include "clench/base/error.h"
#include "clench/math/decompositions.h"

namespace clench {

using Eigen::MatrixXd;
using Eigen::VectorXd;

static EigengraspSet set_of(const Robot& robot) {
  return robot.eigengrasps ? *robot.eigengrasps
                           : identity_eigengrasps(static_cast<int>(robot.dofs.size()));
}

Eigengrasps::Eigengrasps(const Robot& robot) {
  // a hand without DOFs has only one posture
  if (!robot.dofs.empty()) *this = Eigengrasps(set_of(robot), robot.limits);
}

Eigengrasps::Eigengrasps(const EigengraspSet& set, const std::vector<Range>& limits)
    : dof_limits_(limits) {
  check_eigengrasps(set, "eigengrasps");
  if (!limits.empty() && static_cast<int>(limits.size()) != set.dofs)
    fail("eigengrasps: expected a set for {} DOFs, got one for {}", limits.size(), set.dofs);
  const int count = static_cast<int>(set.grasps.size());
  vectors_.resize(count, set.dofs);
  eigenvalues_.resize(count);
  for (int i = 0; i < count; ++i) {
    vectors_.row(i) = set.grasps[i].vector.stableNormalized();
    eigenvalues_[i] = set.grasps[i].eigenvalue;
    own_limits_.push_back(set.grasps[i].limits);
  }
  projection_ = solve_symmetric(vectors_ * vectors_.transpose(), vectors_);

  norm_ = set.norm.value_or(VectorXd::Ones(set.dofs));
  origin_ = set.origin.value_or(VectorXd::Zero(set.dofs));
  for (int d = 0; d < static_cast<int>(limits.size()); ++d) {
    const auto [low, high] = limits[d];
    origin_[d] = set.origin ? std::clamp(origin_[d], low, high) : low + 0.5 * (high - low);
  }
}

static void check_size(const VectorXd& x, int expected, const char* what) {
  if (x.size() != expected) fail("eigengrasps: expected {} {}, got {}", expected, what, x.size());
  for (int i = 0; i < x.size(); ++i)
    if (!number_rule.allows(x[i])) fail("eigengrasps: {}: {}", what, fault(number_rule, x[i]));
}

VectorXd Eigengrasps::amplitudes(const VectorXd& dofs) const {
  check_size(dofs, this->dofs(), "DOF values");
  return projection_ * (dofs - origin_).cwiseQuotient(norm_);
}

VectorXd Eigengrasps::posture(const VectorXd& amplitudes) const {
  check_size(amplitudes, size(), "amplitudes");
  return origin_ + norm_.cwiseProduct(vectors_.transpose() * amplitudes);
}

VectorXd Eigengrasps::posture(const VectorXd& amplitudes, const VectorXd& from) const {
  check_size(amplitudes, size(), "amplitudes");
  const VectorXd change = amplitudes - this->amplitudes(from);
  return from + norm_.cwiseProduct(vectors_.transpose() * change);
}

// a DOF with a smaller component of a unit vector counts as not moved
static constexpr double moves = 1e-9;

std::vector<Range> Eigengrasps::limits(const VectorXd& dofs) const {
  const VectorXd now = amplitudes(dofs);
  std::vector<Range> out;
  for (int i = 0; i < size(); ++i) {
    if (own_limits_[i]) {
      out.push_back(*own_limits_[i]);
      continue;
    }
    double back = -std::numeric_limits<double>::infinity(), forth = -back;
    for (int d = 0; d < static_cast<int>(dof_limits_.size()); ++d) {
      if (std::abs(vectors_(i, d)) < moves) continue;
      const double rate = norm_[d] * vectors_(i, d);
      // from the value of the DOF to its two limits
      const double a = (dof_limits_[d][0] - dofs[d]) / rate,
                   b = (dof_limits_[d][1] - dofs[d]) / rate;
      back = std::max(back, std::min(a, b));
      forth = std::min(forth, std::max(a, b));
    }
    out.push_back({now[i] + std::min(back, 0.0), now[i] + std::max(forth, 0.0)});
  }
  return out;
}

std::vector<Range> Eigengrasps::range() const {
  std::vector<Range> out;
  for (int i = 0; i < size(); ++i) {
    // amplitudes are linear in the DOFs: each extreme is at a limit of every DOF
    const double infinite = std::numeric_limits<double>::infinity();
    Range range = dof_limits_.empty() ? Range{-infinite, infinite} : Range{0, 0};
    for (int d = 0; d < static_cast<int>(dof_limits_.size()); ++d) {
      const double share = projection_(i, d) / norm_[d];
      const double a = share * (dof_limits_[d][0] - origin_[d]),
                   b = share * (dof_limits_[d][1] - origin_[d]);
      range[0] += std::min(a, b);
      range[1] += std::max(a, b);
    }
    out.push_back(own_limits_[i].value_or(range));
  }
  return out;
}

// --- principal components ---

static MatrixXd rows_of(const std::vector<VectorXd>& postures) {
  const int count = static_cast<int>(postures.size());
  if (count < 2) fail("eigengrasps: expected at least 2 postures, got {}", count);
  const int dofs = static_cast<int>(postures[0].size());
  if (dofs < 1) fail("eigengrasps: posture 1: expected DOF values, got none");
  MatrixXd rows(count, dofs);
  for (int i = 0; i < count; ++i) {
    if (postures[i].size() != dofs)
      fail("eigengrasps: posture {}: expected {} DOF values, got {}", i + 1, dofs,
           postures[i].size());
    for (int d = 0; d < dofs; ++d)
      check(number_rule, postures[i][d], fmt::format("eigengrasps: posture {}", i + 1));
    rows.row(i) = postures[i];
  }
  return rows;
}

// +v and -v are the same component; the sign is fixed by the largest entry
static VectorXd with_sign(const VectorXd& v) {
  int largest = 0;
  for (int i = 1; i < v.size(); ++i)
    if (std::abs(v[i]) > std::abs(v[largest]) * (1 + 1e-9)) largest = i;
  return v[largest] < 0 ? VectorXd(-v) : v;
}

EigengraspSet principal_eigengrasps(const std::vector<VectorXd>& postures, int count) {
  MatrixXd rows = rows_of(postures);
  const int dofs = static_cast<int>(rows.cols());
  if (count < 0 || count > dofs) fail("eigengrasps: count: expected 1 to {}, got {}", dofs, count);
  EigengraspSet set;
  set.dofs = dofs;
  set.origin = rows.colwise().mean();
  rows.rowwise() -= set.origin->transpose();

  // ascending eigenvalues
  const MatrixXd covariance = rows.transpose() * rows / static_cast<double>(rows.rows() - 1);
  const auto [values, vectors] = eigensystem(covariance);
  // eigenvalue that rounding can give to a direction without variance
  const double nothing = 1e-12 * std::max(values[dofs - 1], 0.0);
  int varied = 0;
  while (varied < dofs && values[dofs - 1 - varied] > nothing) ++varied;
  if (varied == 0)
    fail("eigengrasps: expected postures that differ, got the same {} times", rows.rows());
  if (count > varied)
    fail("eigengrasps: count: {} postures vary in {} directions only, expected {}", rows.rows(),
         varied, count);
  for (int i = 0; i < (count ? count : varied); ++i)
    set.grasps.push_back(
        {with_sign(vectors.col(dofs - 1 - i)), values[dofs - 1 - i], std::nullopt});
  return set;
}

}  // namespace clench
