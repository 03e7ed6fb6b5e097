// A simplex of points of a set around the origin, or on the way there, for a polytope to start
// with. Includes no Eigen.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "clench/base/hash.h"
#include "clench/grasp/wrench/facet_complex.h"
#include "clench/grasp/wrench/facet_plane.h"

namespace clench {

/// A set thinner than this is flat.
inline constexpr double flat_width = 1e-10;

enum class SimplexEnd {
  found,
  outside,  ///< the set reaches no farther than `zero` along `direction`
  flat      ///< the set lies in a hyperplane normal to `direction`
};

template <int D>
struct Simplex {
  SimplexEnd end = SimplexEnd::found;
  double point[D + 1][D];
  Eight plane[D + 1];  // k: of all points but k, outwards
  double direction[D];
};

// The planes of a simplex whose edges from point 0 have grown the basis one by one.
template <int D>
void find_planes(Simplex<D>& simplex, const Basis<D>& basis) {
  double edge[D][D];  // along the basis: nothing beyond the diagonal
  for (int j = 0; j < D; ++j) {
    double v[D];
    for (int i = 0; i < D; ++i) v[i] = simplex.point[j + 1][i] - simplex.point[0][i];
    for (int i = 0; i <= j; ++i) edge[j][i] = dot<D>(basis.q[i], v);
  }
  for (int k = 0; k <= D; ++k) {
    // along all edges alike, or along none but one
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

/// Grows towards the origin.
/// support  leaves a farthest point along a direction, returns how far it is
/// seed     another one, another simplex
/// throws   BrokenSurface
template <int D, class Support>
Simplex<D> first_simplex(const Support& support, uint64_t seed, double zero) {
  // any direction that no symmetric set is likely to have a face for
  static constexpr double any[] = {0.61, -0.35, 0.47, 0.23, -0.41, 0.29};
  // a simplex thinner than this is built with more care
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
    // from the flat through the points towards the origin
    for (int i = 0; i < D; ++i) u[i] = -origin[i];
    basis.reduce(u);
    double length = std::sqrt(dot<D>(u, u));
    if (length > near) {
      scale(length);
      const double reach = support(u, far);
      if (reach <= zero) return ended(SimplexEnd::outside);
      best = reach + length;
    }
    // the origin is near, or beyond all points: both ways along one direction, and others where
    // that leads nowhere
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
