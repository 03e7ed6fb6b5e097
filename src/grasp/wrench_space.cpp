#include "grasp/wrench_space.h"

#include <cmath>

#include "base/error.h"
#include "grasp/wrench_hull.h"
#include "math/decompositions.h"

namespace clench {

namespace {

// A direction in which the wrenches reach less than this part of the strongest is not spanned: far
// above the rounding of hundreds of wrenches (1e-15), far below any lever or friction that could
// hold something.
constexpr double rank_tolerance = 1e-10;

// A facet nearer to the origin than this part of the largest wrench goes through it: qhull's planes
// are good to some 1e-14 of the points' extent.
constexpr double on_boundary = 1e-12;

Eigen::MatrixXd side_by_side(const std::vector<Wrenches>& contacts) {
  Eigen::Index count = 0;
  for (const Wrenches& wrenches : contacts) count += wrenches.cols();
  Eigen::MatrixXd all(6, count);
  Eigen::Index column = 0;
  for (size_t contact = 0; contact < contacts.size(); ++contact)
    for (Eigen::Index k = 0; k < contacts[contact].cols(); ++k) {
      const Vector6d w = contacts[contact].col(k);
      for (const double x : w)
        if (!std::isfinite(x))
          fail("wrench space: contact {}, wrench {}: numbers must be finite, got {}", contact + 1,
               k + 1, x);
      all.col(column++) = w;
    }
  return all;
}

Eigen::MatrixXd times_power_of_two(const Eigen::MatrixXd& m, int exponent) {
  return m.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
}

// of the two unit vectors along a line the one whose largest component is positive
Vector6d upright(const Vector6d& direction) {
  int largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? Vector6d(-direction) : direction;
}

}  // namespace

WrenchSpace::WrenchSpace(std::vector<Wrenches> contacts) : contacts_(std::move(contacts)) {
  Eigen::MatrixXd all = side_by_side(contacts_);
  const double largest = all.size() > 0 ? all.cwiseAbs().maxCoeff() : 0;
  hull_.dimension = 6;
  weakest_.direction = Vector6d::Unit(0);
  if (largest == 0) return;

  // of size one, exactly: a power of two changes no digit
  const int exponent = std::ilogb(largest) + 1;
  all = times_power_of_two(all, -exponent);

  // what no contact pushes along is not resisted at all
  const Svd svd = singular_value_decomposition(all);
  rank_ = static_cast<int>((svd.values.array() > rank_tolerance * svd.values[0]).count());
  hull_.rank = affine_rank(all, rank_tolerance);
  if (rank_ < 6) {
    weakest_.direction = upright(svd.u.col(5));
    return;
  }

  hull_ = wrench_hull(all);
  double offset = 0;
  if (hull_.full()) {
    int facet = 0;
    offset = hull_.offsets.minCoeff(&facet);
    weakest_.direction = -hull_.normals.col(facet);
  } else {
    // all wrenches lie in one hyperplane beside the origin, n . w = 1: they push along n only
    const Eigen::VectorXd along = svd.v.transpose() * Eigen::VectorXd::Ones(all.cols());
    const Vector6d n = svd.u * along.cwiseQuotient(svd.values);
    offset = -1 / n.norm();
    weakest_.direction = n.normalized();
  }
  if (std::abs(offset) <= on_boundary * all.colwise().norm().maxCoeff()) offset = 0;

  weakest_.resistance = std::ldexp(offset, exponent);
  epsilon_ = std::max(0.0, weakest_.resistance);
  hull_.offsets = times_power_of_two(hull_.offsets, exponent);
  hull_.volume = std::ldexp(hull_.volume, 6 * exponent);
  hull_.area = std::ldexp(hull_.area, 5 * exponent);
}

}  // namespace clench
