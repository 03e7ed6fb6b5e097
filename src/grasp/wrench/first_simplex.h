// Initial simplex for a polytope: points of a set that enclose the origin, or approach it. Includes
// no Eigen.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "clench/base/hash.h"
#include "clench/grasp/wrench/facet_complex.h"
#include "clench/grasp/wrench/facet_plane.h"

namespace clench {

/// A thinner set is flat.
inline constexpr double flat_width = 1e-10;

enum class SimplexEnd {
  found,
  outside,  ///< the support along `direction` is at most `zero`
  flat      ///< the set lies in a hyperplane normal to `direction`
};

template <int D>
struct Simplex {
  SimplexEnd end = SimplexEnd::found;
  double point[D + 1][D];
  Eight plane[D + 1];  // k: of all points but k, outwards
  double direction[D];
};

// The planes of a simplex whose edges from point 0 were added to the basis one by one.
template <int D>
void find_planes(Simplex<D>& simplex, const Basis<D>& basis) {
  double edge[D][D];  // components along the basis: zero beyond the diagonal
  for (int j = 0; j < D; ++j) {
    double v[D];
    for (int i = 0; i < D; ++i) v[i] = simplex.point[j + 1][i] - simplex.point[0][i];
    for (int i = 0; i <= j; ++i) edge[j][i] = dot<D>(basis.q[i], v);
  }
  for (int k = 0; k <= D; ++k) {
    // the normal of facet 0 has equal components along all edges; that of facet k is orthogonal to
    // all edges but one
    double along[D], normal[D] = {};
    for (int i = 0; i < D; ++i) {
      along[i] = k == 0 ? 1 : i == k - 1 ? -1 : 0;
      for (int j = 0; j < i; ++j) along[i] -= edge[i][j] * along[j];
      along[i] /= edge[i][i];
      for (int row = 0; row < D; ++row) normal[row] += along[i] * basis.q[i][row];
    }
    const double length = std::sqrt(dot<D>(normal, normal));
    Eight& plane = simplex.plane[k];
    for (int row = 0; row < D; ++row) plane.x[row] = normal[row] / length;
    plane.x[behind] = -dot<D>(plane.x, simplex.point[k == 0]);
  }
}

/// Expands towards the origin.
/// support  writes a farthest point along a direction, and returns its support
/// seed     another seed gives another simplex
/// throws   BrokenSurface
template <int D, class Support>
Simplex<D> first_simplex(const Support& support, uint64_t seed, double zero) {
  // a direction for which symmetric sets are unlikely to have a face
  static constexpr double any[] = {0.61, -0.35, 0.47, 0.23, -0.41, 0.29};
  // a thinner simplex is built with more care
  constexpr double near = 1e-3;
  Simplex<D> out;
  double *u = out.direction, p[D];
  uint64_t state = seed;
  const auto random = [&] {
    state = Hasher::mix(state + 1);
    return static_cast<double>(state >> 11) * 0x1p-52 - 1;
  };
  const auto ended = [&](SimplexEnd end) { return out.end = end, out; };
  const auto scale = [&](double length) {
    for (int i = 0; i < D; ++i) u[i] /= length;
  };
  for (int i = 0; i < D; ++i) u[i] = seed == 0 ? any[i] : random();
  scale(std::sqrt(dot<D>(u, u)));
  const double* origin = out.point[0];
  if (support(u, out.point[0]) <= zero) return ended(SimplexEnd::outside);
  Basis<D> basis;
  while (basis.count < D) {
    double best = 0;
    double* far = out.point[basis.count + 1];
    std::copy_n(origin, D, far);
    // from the affine hull of the points towards the origin
    for (int i = 0; i < D; ++i) u[i] = -origin[i];
    basis.reduce(u);
    double length = std::sqrt(dot<D>(u, u));
    if (length > near) {
      scale(length);
      const double reach = support(u, far);
      if (reach <= zero) return ended(SimplexEnd::outside);
      best = reach + length;
    }
    // the origin is near, or beyond all points: both signs of one direction, and other directions
    // if those fail
    for (int trial = 0; trial < 8 && best < near; ++trial) {
      do {
        for (int i = 0; i < D; ++i) u[i] = random();
        basis.reduce(u);
        length = std::sqrt(dot<D>(u, u));
      } while (length < 1e-2);
      scale(length);
      const double base = dot<D>(u, origin);
      for (int side = 0; side < 2; ++side) {
        if (support(u, p) <= zero) return ended(SimplexEnd::outside);
        const double extent = std::abs(dot<D>(u, p) - (side ? -base : base));
        if (extent > best) best = extent, std::copy_n(p, D, far);
        scale(-1);
      }
    }
    if (best <= flat_width) return ended(SimplexEnd::flat);
    double edge[D];
    for (int i = 0; i < D; ++i) edge[i] = far[i] - origin[i];
    if (basis.add(edge) <= 0.5 * flat_width) throw BrokenSurface();
  }
  find_planes(out, basis);
  return out;
}

}  // namespace clench
