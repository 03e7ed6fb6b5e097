#include "contact/friction_edges.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"

namespace clench {

FrictionEdges friction_edges(double torsion_radius) {
  if (!(torsion_radius >= 0) || !std::isfinite(torsion_radius))
    fail("friction edges: wanted a torsion radius >= 0 [m], got {}", torsion_radius);
  constexpr double pi = std::numbers::pi, millimetre = 1e-3;
  constexpr std::pair<double, int> all[] = {
      {pi / 2, 1}, {pi / 4, 5}, {0, 8}, {-pi / 4, 5}, {-pi / 2, 1}};
  const bool soft = torsion_radius > 0;
  FrictionEdges edges = FrictionEdges::Zero(6, soft ? 20 : 8);
  int next = 0;
  for (const auto& [latitude, directions] : all) {
    if (!soft && latitude != 0) continue;
    // from the unit sphere out to the ellipsoid, in the same direction
    const double across = directions == 1 ? 0 : std::cos(latitude), along = std::sin(latitude);
    const double length = soft ? std::hypot(across, along * millimetre / torsion_radius) : 1;
    for (int i = 0; i < directions; ++i, ++next) {
      const double turn = 2 * pi * i / directions;
      edges(0, next) = across * std::cos(turn) / length;
      edges(1, next) = across * std::sin(turn) / length;
      edges(5, next) = along * millimetre / length;
    }
  }
  return edges;
}

}  // namespace clench
