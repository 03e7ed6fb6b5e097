// Small meshes with known properties, for tests.
#pragma once
#include <cmath>
#include <numbers>

#include "clench/geometry/tree/shape.h"

namespace clench::test {

/// Closed box, centered, 12 triangles.
inline Mesh box(double x, double y, double z) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(
        {(i & 1 ? 0.5 : -0.5) * x, (i & 2 ? 0.5 : -0.5) * y, (i & 4 ? 0.5 : -0.5) * z});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

/// Closed ball of rings and segments about z.
inline Mesh ball(double radius, int rings = 12, int segments = 24) {
  Mesh m;
  const double pi = std::numbers::pi;
  m.vertices.push_back({0, 0, radius});
  for (int r = 1; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const double polar = pi * r / rings, around = 2 * pi * s / segments;
      m.vertices.push_back({radius * std::sin(polar) * std::cos(around),
                            radius * std::sin(polar) * std::sin(around), radius * std::cos(polar)});
    }
  m.vertices.push_back({0, 0, -radius});
  const auto at = [&](int r, int s) { return 1 + (r - 1) * segments + s % segments; };
  const int south = static_cast<int>(m.vertices.size()) - 1;
  for (int s = 0; s < segments; ++s) {
    m.triangles.push_back({0, at(1, s), at(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      m.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      m.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
    m.triangles.push_back({south, at(rings - 1, s + 1), at(rings - 1, s)});
  }
  return m;
}

}  // namespace clench::test
