#include "clench/contact/friction_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "clench/base/convert.h"
#include "clench/base/error.h"

namespace clench {

FrictionEdges friction_edges(double torsion_radius, int directions, double even_in) {
  if (!(torsion_radius >= 0) || !std::isfinite(torsion_radius))
    fail("friction edges: expected a torsion radius >= 0 [m], got {}", torsion_radius);
  if (directions < 3) fail("friction edges: expected 3 directions or more, got {}", directions);
  constexpr double pi = std::numbers::pi;
  const bool soft = torsion_radius > 0;
  const int rings = soft ? std::clamp((directions + 2) / 4, 1, 16) : 0;
  std::vector<std::pair<double, int>> all;
  for (int k = rings; k >= -rings; --k) {
    const double latitude = k * (pi / 2) / std::max(rings, 1);
    const int around = floor_int(directions * std::cos(latitude));
    all.emplace_back(latitude, k == 0                 ? directions
                               : std::abs(k) == rings ? 1
                                                      : std::max(around, 1));
  }
  int count = 0;
  for (const auto& ring : all) count += ring.second;
  FrictionEdges edges = FrictionEdges::Zero(6, count);
  int next = 0;
  for (const auto& [latitude, around] : all) {
    // projects from the unit sphere to the ellipsoid along the same direction
    const bool pole = soft && std::abs(latitude) == pi / 2;
    const double across = pole ? 0 : std::cos(latitude), along = std::sin(latitude);
    const double length = soft ? std::hypot(across, along * (even_in / torsion_radius)) : 1;
    for (int i = 0; i < around; ++i, ++next) {
      const double turn = 2 * pi * i / around;
      edges(0, next) = across * std::cos(turn) / length;
      edges(1, next) = across * std::sin(turn) / length;
      edges(5, next) = along * even_in / length;
    }
  }
  return edges;
}

}  // namespace clench
