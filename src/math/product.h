// Products of large matrices that can be interrupted.
#pragma once
#include <Eigen/Core>
#include <algorithm>

#include "clench/base/watched.h"

namespace clench {

/// Calls take(first, count) for consecutive groups of columns of a product, with a check_stop()
/// before each: a group takes about 30 ms at most. Eigen computes four columns at once and a single
/// one by other means, so groups of a multiple of four give the same bits as the undivided product.
/// rows, inner  of the product: each of its entries is a sum of `inner` terms
template <class Take>
void in_column_parts(Eigen::Index columns, Eigen::Index rows, Eigen::Index inner, Take take) {
  constexpr double terms_between_checks = 2e8;
  const double column = std::max(1.0, static_cast<double>(rows) * static_cast<double>(inner));
  const auto fours = static_cast<Eigen::Index>(terms_between_checks / column / 4);
  const Eigen::Index step = 4 * std::max<Eigen::Index>(1, fours);
  for (Eigen::Index first = 0, count; first < columns; first += count) {
    const Eigen::Index left = columns - first;
    count = left < step + 4 ? left : step;
    check_stop();
    take(first, count);
  }
}

/// a * b, bit-exactly.   throws  Stopped
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace clench
