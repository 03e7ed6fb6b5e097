// Orthonormal directions, and planes through points by elimination. Includes no Eigen.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clench {

template <int D>
double dot(const double* a, const double* b) {
  double sum = a[0] * b[0];
  for (int i = 1; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

/// Orthonormal directions, built one by one.
template <int D>
struct Basis {
  double q[D][D] = {};
  int count = 0;

  /// the component of v normal to all of them
  void reduce(double* v) const {
    for (int pass = 0; pass < 2; ++pass)
      for (int k = 0; k < count; ++k) {
        const double along = dot<D>(q[k], v);
        for (int i = 0; i < D; ++i) v[i] -= along * q[k][i];
      }
  }
  /// returns  length of the new component of v
  double add(const double* v) {
    double* next = q[count];
    std::copy_n(v, D, next);
    reduce(next);
    const double length = std::sqrt(dot<D>(next, next));
    if (length > 0) {
      for (int i = 0; i < D; ++i) next[i] /= length;
      ++count;
    }
    return length;
  }
};

/// The corners of a facet.
template <int D>
struct FacetCorners {
  double x[D][D];
};

/// Support of points along a direction.
struct Spread {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double width() const { return high - low; }
};

template <int D>
Spread spread_along(const double* direction, const FacetCorners<D>& corners) {
  Spread out;
  for (int k = 0; k < D; ++k) {
    const double x = dot<D>(direction, corners.x[k]);
    out.low = std::min(out.low, x), out.high = std::max(out.high, x);
  }
  return out;
}

/// Corrects a unit normal to that of the plane spanned by D points, as far as they determine it:
/// the longest edges first; a component that the shortest leave undetermined is kept.
/// returns  height of the points along it
template <int D>
Spread true_normal(double* normal, const FacetCorners<D>& corners) {
  const Spread before = spread_along<D>(normal, corners);
  double edges[D - 1][D];
  for (int k = 1; k < D; ++k)
    for (int i = 0; i < D; ++i) edges[k - 1][i] = corners.x[k][i] - corners.x[0][i];
  Basis<D> basis;
  for (int k = 0; k < D - 1; ++k) {
    int longest = k;
    double most = -1;
    for (int j = k; j < D - 1; ++j) {
      basis.reduce(edges[j]);
      const double square = dot<D>(edges[j], edges[j]);
      if (square > most) most = square, longest = j;
    }
    if (most < 1e-24) break;
    std::swap_ranges(edges[k], edges[k] + D, edges[longest]);
    basis.add(edges[k]);
  }
  double n[D];
  std::copy_n(normal, D, n);
  basis.reduce(n);
  const double length = std::sqrt(dot<D>(n, n));
  if (!(length > 0.5)) return before;
  for (int i = 0; i < D; ++i) n[i] /= length;
  const Spread after = spread_along<D>(n, corners);
  if (after.width() >= before.width()) return before;
  std::copy_n(n, D, normal);
  return after;
}

}  // namespace clench
