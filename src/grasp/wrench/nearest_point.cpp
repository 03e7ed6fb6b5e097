#include "clench/grasp/wrench/nearest_point.h"

#include <algorithm>
#include <cmath>

#include "clench/base/watched.h"

namespace clench {

namespace {

// far more steps than six-dimensional sets need, which is a few dozen
constexpr int max_steps = 2000;

// Weights, with sum one, of the points whose mean is the point of their affine hull nearest to the
// origin.
// returns  false if they are no simplex
bool nearest_shares(const Eigen::MatrixXd& corners, Eigen::VectorXd& shares) {
  const int d = static_cast<int>(corners.rows()), count = static_cast<int>(corners.cols());
  if (count > d + 1) return false;
  // edges = q r by Gram-Schmidt, twice; then r x = -q^T c0
  Eigen::MatrixXd q(d, count - 1), r = Eigen::MatrixXd::Zero(count - 1, count - 1);
  for (int k = 0; k < count - 1; ++k) {
    Eigen::VectorXd v = corners.col(k + 1) - corners.col(0);
    const double whole = v.norm();
    for (int pass = 0; pass < 2; ++pass)
      for (int j = 0; j < k; ++j) {
        const double along = q.col(j).dot(v);
        r(j, k) += along;
        v -= along * q.col(j);
      }
    r(k, k) = v.norm();
    if (!(r(k, k) > 1e-12 * whole)) return false;
    q.col(k) = v / r(k, k);
  }
  Eigen::VectorXd x = -q.transpose() * corners.col(0);
  for (int k = count - 2; k >= 0; --k) {
    for (int j = k + 1; j < count - 1; ++j) x[k] -= r(k, j) * x[j];
    x[k] /= r(k, k);
  }
  shares.resize(count);
  shares[0] = 1 - x.sum();
  shares.tail(count - 1) = x;
  return true;
}

// points of the set, one per column, and their weights in the nearest point so far
struct NearSimplex {
  Eigen::MatrixXd corners;
  Eigen::VectorXd shares;

  Eigen::VectorXd point() const { return corners * shares; }

  void add(const Eigen::VectorXd& corner) {
    corners.conservativeResize(Eigen::NoChange, corners.cols() + 1);
    corners.rightCols(1) = corner;
    shares.conservativeResize(shares.size() + 1);
    shares[shares.size() - 1] = 0;
  }

  template <class Keep>
  void keep_where(Keep keep) {
    std::vector<int> kept;
    for (int i = 0; i < shares.size(); ++i)
      if (keep(i)) kept.push_back(i);
    corners = corners(Eigen::all, kept).eval();
    shares = shares(kept).eval();
    shares /= shares.sum();
  }

  // Weights of the point nearest to the origin, without the corners that do not contribute.
  // returns  false if rounding leaves no simplex: the last corner adds nothing
  bool reduce() {
    Eigen::VectorXd expected;
    while (nearest_shares(corners, expected)) {
      if (expected.minCoeff() > 0) {
        shares = expected;
        return true;
      }
      // as far towards it as all weights stay nonnegative
      double part = 2;  // all are at most 1
      int blocking = 0;
      for (int i = 0; i < expected.size(); ++i) {
        if (expected[i] > 0) continue;
        const double ratio = std::max(0.0, shares[i] / (shares[i] - expected[i]));
        if (ratio < part) part = ratio, blocking = i;
      }
      shares += part * (expected - shares);
      keep_where([&](int i) { return i != blocking; });
    }
    keep_where([&](int i) { return shares[i] > 0; });
    return false;
  }
};

}  // namespace

NearestPoint nearest_point(const SupportSet& set, const Eigen::VectorXd& place, double noise) {
  const int d = set.dimension();
  const auto reach = [&](const Eigen::VectorXd& direction) {
    check_stop();
    Eigen::VectorXd point(d);
    set.support(direction.data(), point.data());
    return Eigen::VectorXd(point - place);
  };
  NearSimplex simplex{reach(Eigen::VectorXd::Ones(d)), Eigen::VectorXd::Ones(1)};
  Eigen::VectorXd point = simplex.corners.col(0);
  int idle = 0;
  for (int step = 0; step < max_steps; ++step) {
    const double distance = point.norm();
    if (distance <= noise) break;
    const Eigen::VectorXd next = reach(-point / distance);
    // no point of the set is nearer than this along the direction
    if (point.dot(point - next) <= noise * distance) break;
    simplex.add(next);
    if (!simplex.reduce()) break;
    const Eigen::VectorXd now = simplex.point();
    const bool nearer = now.norm() < distance;
    point = now;
    // the new point gave all possible improvement
    if (!nearer && ++idle > 3) break;
  }
  NearestPoint out;
  out.distance = point.norm();
  out.point = point + place;
  out.corners = simplex.corners.colwise() + place;
  out.shares.assign(simplex.shares.data(), simplex.shares.data() + simplex.shares.size());
  return out;
}

}  // namespace clench
