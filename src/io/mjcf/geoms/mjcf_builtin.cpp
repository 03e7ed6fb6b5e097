#include "clench/io/mjcf/geoms/mjcf_builtin.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/base/suggest.h"
#include "clench/base/text.h"
#include "clench/base/units.h"

namespace clench {

namespace {

using std::numbers::pi;

constexpr int max_resolution = 300;  // about 200,000 triangles

struct Params {
  const std::string& kind;
  const std::vector<double>& values;

  int integer(int i, const char* name, int low, int high) const {
    const double x = values[i];
    if (!(x >= low && x <= high) || x != std::floor(x))
      fail("{}: {}: expected a whole number from {} to {}, got {}", kind, name, low, high, x);
    return floor_int(x);
  }
  /// greater than low, or equal to it if `closed`
  double number(int i, const char* name, double low, bool closed, double high) const {
    const double x = values[i];
    if (!(closed ? x >= low : x > low) || !(x <= high))
      fail("{}: {}: expected a number {} {} and <= {}, got {}", kind, name, closed ? ">=" : ">",
           low, high, x);
    return x;
  }
};

/// Unit sphere from an icosahedron: triangles are divided into four, vertices moved onto the
/// sphere.
Mesh sphere(const Params& params) {
  const int cuts = params.integer(0, "subdivision", 0, 4);
  const double a = 1 / std::sqrt(1 + std::numbers::phi * std::numbers::phi),
               b = std::numbers::phi * a;
  Mesh mesh;
  mesh.vertices = {{-a, b, 0},  {a, b, 0},  {-a, -b, 0}, {a, -b, 0}, {0, -a, b},  {0, a, b},
                   {0, -a, -b}, {0, a, -b}, {b, 0, -a},  {b, 0, a},  {-b, 0, -a}, {-b, 0, a}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [at, is_new] =
          middles.try_emplace(std::minmax(i, j), static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[i] + mesh.vertices[j]).normalized());
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : mesh.triangles) {
      const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  return mesh;
}

/// The upper half of an octahedron whose faces are divided evenly, projected onto the unit sphere,
/// and a flat disk below.
Mesh hemisphere(const Params& params) {
  const int n = params.integer(0, "resolution", 0, 10) + 1;
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, 1);
  const auto number = [](int ring, int i) {  // of ring 1..n, which has 4 ring vertices
    return 1 + 2 * ring * (ring - 1) + i % (4 * ring);
  };
  constexpr std::array<std::array<double, 2>, 5> corners = {
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}}};
  for (int ring = 1; ring <= n; ++ring)
    for (int i = 0; i < 4 * ring; ++i) {
      const auto &from = corners[i / ring], &to = corners[i / ring + 1];
      const double t = i % ring;
      mesh.vertices.push_back(Eigen::Vector3d((ring - t) * from[0] + t * to[0],
                                              (ring - t) * from[1] + t * to[1], n - ring)
                                  .normalized());
    }
  for (int ring = 1; ring <= n; ++ring)
    for (int side = 0; side < 4; ++side)
      for (int i = 0; i < ring; ++i) {
        const int out = side * ring + i, in = side * (ring - 1) + i;
        const auto above = [&](int k) { return ring == 1 ? 0 : number(ring - 1, k); };
        mesh.triangles.push_back({above(in), number(ring, out), number(ring, out + 1)});
        if (i + 1 < ring)
          mesh.triangles.push_back({above(in), number(ring, out + 1), above(in + 1)});
      }
  const int center = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i < 4 * n; ++i)
    mesh.triangles.push_back({number(n, i), center, number(n, i + 1)});
  return mesh;
}

Mesh cone(const Params& params) {
  const int n = params.integer(0, "nvert", 3, max_resolution);
  const double radius = params.number(1, "radius", 0, true, 1);
  Mesh mesh;
  for (const double z : {-1.0, 1.0})
    for (int i = 0; i < n; ++i) {
      const double r = z < 0 ? 1 : radius, angle = 2 * pi * i / n;
      if (r > 0) mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  if (radius == 0) mesh.vertices.emplace_back(0, 0, 1);
  return mesh;
}

/// |cos|^e or |sin|^e with the sign.
double signed_power(double x, double exponent) {
  if (std::abs(x) < 1e-15) return exponent == 0 ? 0 : x;
  return std::copysign(std::pow(std::abs(x), exponent), x);
}

/// source  Barr (1981), superquadrics
Mesh supersphere(const Params& params) {
  const int n = params.integer(0, "resolution", 3, max_resolution);
  const double e = params.number(1, "e", 0, true, 100), north = params.number(2, "n", 0, true, 100);
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, -1);
  for (int i = 1; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double v = -pi / 2 + pi * i / n, u = -pi + 2 * pi * k / n;
      const double r = signed_power(std::cos(v), north);
      mesh.vertices.emplace_back(r * signed_power(std::cos(u), e), r * signed_power(std::sin(u), e),
                                 signed_power(std::sin(v), north));
    }
  const int top = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, 1);
  const auto number = [&](int ring, int k) { return 1 + (ring - 1) * n + k % n; };
  for (int k = 0; k < n; ++k) mesh.triangles.push_back({0, number(1, k + 1), number(1, k)});
  for (int ring = 1; ring + 1 < n; ++ring)
    for (int k = 0; k < n; ++k) {
      const int a = number(ring, k), b = number(ring, k + 1), c = number(ring + 1, k),
                d = number(ring + 1, k + 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({b, d, c});
    }
  for (int k = 0; k < n; ++k)
    mesh.triangles.push_back({number(n - 1, k), number(n - 1, k + 1), top});
  return mesh;
}

Mesh supertorus(const Params& params) {
  const int n = params.integer(0, "resolution", 3, max_resolution);
  const double radius = params.number(1, "radius", 0, false, 1),
               s = params.number(2, "s", 0, false, 100), t = params.number(3, "t", 0, false, 100);
  Mesh mesh;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double u = 2 * pi * i / n, v = 2 * pi * k / n;
      const double r = 1 + radius * signed_power(std::cos(v), s);
      mesh.vertices.emplace_back(r * signed_power(std::cos(u), t), r * signed_power(std::sin(u), t),
                                 radius * signed_power(std::sin(v), s));
    }
  const auto number = [&](int i, int k) { return i % n * n + k % n; };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      mesh.triangles.push_back({number(i, k), number(i + 1, k), number(i, k + 1)});
      mesh.triangles.push_back({number(i + 1, k), number(i + 1, k + 1), number(i, k + 1)});
    }
  return mesh;
}

/// Centers of cells that divide a part of the unit sphere around -z; points without triangles.
Mesh wedge(const Params& params) {
  const int across = params.integer(0, "res_phi", 1, max_resolution),
            along = params.integer(1, "res_theta", 1, max_resolution);
  const double phi = params.number(2, "fov_phi", 0, false, 180) * units::degree,
               theta = params.number(3, "fov_theta", 0, false, 90) * units::degree;
  if (params.values[4] != 0)
    fail("wedge: gamma: only evenly spaced points are read; expected 0, got {}", params.values[4]);
  Mesh mesh;
  for (int i = 0; i < across; ++i)
    for (int k = 0; k < along; ++k) {
      const double a = phi * (-1 + (2 * i + 1.0) / across),
                   b = theta * (-1 + (2 * k + 1.0) / along);
      mesh.vertices.emplace_back(std::sin(a) * std::cos(b), std::sin(b),
                                 -std::cos(a) * std::cos(b));
    }
  return mesh;
}

/// Centers of the cells of a square of side 2, at z = -1.
Mesh plate(const Params& params) {
  const int nx = params.integer(0, "res_x", 1, max_resolution),
            ny = params.integer(1, "res_y", 1, max_resolution);
  Mesh mesh;
  for (int i = 0; i < nx; ++i)
    for (int k = 0; k < ny; ++k)
      mesh.vertices.emplace_back(-1 + (2 * i + 1.0) / nx, -1 + (2 * k + 1.0) / ny, -1);
  for (int i = 0; i + 1 < nx; ++i)
    for (int k = 0; k + 1 < ny; ++k) {
      const int a = i * ny + k, b = a + ny;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b + 1, a + 1, b});
    }
  return mesh;
}

}  // namespace

Mesh builtin_mesh(const std::string& kind, const std::vector<double>& params) {
  struct Kind {
    size_t count;
    Mesh (*make)(const Params&);
  };
  static const std::map<std::string, Kind> kinds = {{"sphere", {1, sphere}},
                                                    {"hemisphere", {1, hemisphere}},
                                                    {"cone", {2, cone}},
                                                    {"supersphere", {3, supersphere}},
                                                    {"supertorus", {4, supertorus}},
                                                    {"wedge", {5, wedge}},
                                                    {"plate", {2, plate}}};
  const auto found = kinds.find(kind);
  if (found == kinds.end()) {
    std::vector<std::string> names;
    for (const auto& entry : kinds) names.push_back(entry.first);
    fail("expected one of {}, got {}{}", name_list(names), in_quotes(kind),
         did_you_mean(kind, names));
  }
  if (params.size() != found->second.count)
    fail("{}: expected {} parameter{}, got {}", kind, found->second.count,
         found->second.count > 1 ? "s" : "", params.size());
  return found->second.make({kind, params});
}

}  // namespace clench
