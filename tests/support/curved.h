// Meshes of curved surfaces with any resolution, with vertices on the surface, and a floor: for
// tests of curvature.
#pragma once
#include <functional>
#include <map>

#include "support/meshes.h"

namespace clench::test {

/// A board whose upper face lies in the plane z = 0 around the origin.
inline Mesh floor_board() { return moved(box(0.2, 0.2, 0.02), Pose::translation({0, 0, -0.01})); }

/// z = height(x, y) over a square of half width `half`, with `cells` cells per side, seen from
/// above; vertices moved within the plane by up to `jitter` of a cell.
inline Mesh graph(const std::function<double(double, double)>& height, double half, int cells,
                  double jitter = 0, uint64_t seed = 1) {
  Random random(seed);
  Mesh mesh;
  const double step = 2 * half / cells;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const double x = -half + step * (i + jitter * random.uniform(-1, 1));
      const double y = -half + step * (j + jitter * random.uniform(-1, 1));
      mesh.vertices.push_back({x, y, height(x, y)});
    }
  const int row = cells + 1;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int at = j * row + i;
      mesh.triangles.push_back({at, at + 1, at + row + 1});
      mesh.triangles.push_back({at, at + row + 1, at + row});
    }
  return mesh;
}

/// Ball of 20 * 4^subdivisions triangles.
inline Mesh icosphere(double radius, int subdivisions) {
  const double g = (1 + std::sqrt(5)) / 2;
  Mesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int n = 0; n < subdivisions; ++n) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(i, j));
      if (is_new) {
        found->second = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(
            (mesh.vertices[i].normalized() + mesh.vertices[j].normalized()).eval());
      }
      return found->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        finer.push_back(t);
    }
    mesh.triangles = finer;
  }
  for (auto& p : mesh.vertices) p = radius * p.normalized();
  return mesh;
}

/// Along x, closed by caps: `segments` around, of two long triangles each.
inline Mesh rod(double radius, double length, int segments) {
  Mesh mesh;
  for (const double x : {-length / 2, length / 2}) {
    for (int s = 0; s < segments; ++s) {
      const double angle = 2 * std::numbers::pi * s / segments;
      mesh.vertices.push_back({x, radius * std::sin(angle), -radius * std::cos(angle)});
    }
    mesh.vertices.push_back({x, 0, 0});
  }
  const int other = segments + 1;
  for (int s = 0; s < segments; ++s) {
    const int next = (s + 1) % segments;
    mesh.triangles.push_back({s, other + s, other + next});
    mesh.triangles.push_back({s, other + next, next});
    mesh.triangles.push_back({s, next, segments});
    mesh.triangles.push_back({other + s, other + segments, other + next});
  }
  if (Shape::make(mesh)->solid().volume < 0) mesh = inverted(mesh);
  return mesh;
}

/// About z: the tube of radius `tube` around a circle of radius `ring`.
inline Mesh torus(double ring, double tube, int around, int along) {
  Mesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / along;
      const double r = ring + tube * std::cos(v);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return (i % around) * along + j % along; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

}  // namespace clench::test
