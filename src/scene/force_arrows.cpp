#include "scene/force_arrows.h"

#include <algorithm>

#include "scene/palette.h"

namespace clench {

static constexpr double invisible = 1e-3;  // of the largest force
static constexpr double slender = 0.035;   // radius of the longest arrow, part of its length

static double largest_force(std::span<const PlacedForce> forces) {
  double largest = 0;
  for (const PlacedForce& force : forces) largest = std::max(largest, force.f_W.norm());
  return largest;
}

std::vector<DrawArrow> force_arrows(std::span<const PlacedForce> forces, double metres_per_newton) {
  const double largest = largest_force(forces);
  std::vector<DrawArrow> arrows;
  for (const PlacedForce& force : forces) {
    if (force.f_W.norm() <= invisible * largest) continue;
    arrows.push_back({.tail = force.p_W - metres_per_newton * force.f_W,
                      .tip = force.p_W,
                      .radius = slender * metres_per_newton * largest,
                      .color = palette::force});
  }
  return arrows;
}

double force_scale(std::span<const PlacedForce> forces, double longest) {
  const double largest = largest_force(forces);
  return largest > 0 ? longest / largest : 1;
}

}  // namespace clench
