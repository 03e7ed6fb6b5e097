#include <algorithm>
#include <cmath>
#include <numbers>

#include "clench/base/convert.h"
#include "clench/base/error.h"
#include "clench/io/inventor/inventor_faces.h"

namespace clench {

namespace {

using K = InventorKind;
using Ring = std::vector<InventorVector>;

constexpr size_t max_extrusion_points = 1'000'000;  // of all cross sections together

/// Number of slices of a round shape; `finest` at complexity 1.
int slices_of(float complexity, int finest, int least) {
  return std::max(floor_int(complexity * static_cast<float>(finest)), least);
}

void add_triangle(InventorSurface& surface, const InventorVector& a, const InventorVector& b,
                  const InventorVector& c, int color) {
  surface.add(std::array{a, b, c}, color);
}

/// A triangle fan over the corners of a flat ring, from its first corner.
void add_fan(InventorSurface& surface, const Ring& ring, int color) {
  for (size_t i = 1; i + 1 < ring.size(); ++i)
    add_triangle(surface, ring[0], ring[i], ring[i + 1], color);
}

void cut_cube(const InventorNode& shape, const InventorState& state, InventorSurface& surface) {
  InventorVector half;
  if (shape.type->name == "Box")
    for (int i = 0; i < 3; ++i) half[i] = shape.numbers("size")[i] * 0.5f;
  else
    half = {shape.number("width") * 0.5f, shape.number("height") * 0.5f,
            shape.number("depth") * 0.5f};
  // front, back, left, right, top, bottom, each as a cycle of corners; set bits of x, y, z mean
  // minus
  constexpr int sides[6][4] = {{0, 1, 3, 2}, {5, 4, 6, 7}, {1, 5, 7, 3},
                               {4, 0, 2, 6}, {4, 5, 1, 0}, {2, 3, 7, 6}};
  for (int side = 0; side < 6; ++side) {
    Ring ring;
    for (const int corner : sides[side])
      ring.push_back({corner & 1 ? -half[0] : half[0], corner & 2 ? -half[1] : half[1],
                      corner & 4 ? -half[2] : half[2]});
    add_fan(surface, ring, state.binding == ColorBinding::face ? side : 0);
  }
}

/// Points on a circle about y, from -z via -x.
Ring circle(float radius, float y, int slices) {
  Ring out;
  const auto step = static_cast<float>(2 * std::numbers::pi / slices);
  float angle = 0;
  for (int i = 0; i < slices; ++i, angle += step)
    out.push_back({-std::sin(angle) * radius, y, -std::cos(angle) * radius});
  return out;
}

/// True if the shape has that part, "SIDES" or "side".
bool has_part(const InventorNode& shape, std::string_view name, const char* field) {
  if (shape.type->field(field)) return shape.integer(field) != 0;
  const auto& parts = shape.words("parts");
  return std::ranges::count(parts, name) > 0 || std::ranges::count(parts, "ALL") > 0;
}

/// Cylinders and cones.
void cut_round(const InventorNode& shape, const InventorState& state, InventorSurface& surface) {
  const bool cone = shape.type->kind == K::cone;
  const int slices = slices_of(state.complexity, 40, 4);
  const float half = shape.number("height") * 0.5f,
              radius = shape.number(cone ? "bottomRadius" : "radius");
  // the side ends at its first point
  Ring low = circle(radius, -half, slices);
  low.push_back(low[0]);
  Ring high = low;
  for (auto& p : high) p = cone ? InventorVector{0, half, 0} : InventorVector{p[0], half, p[2]};
  if (has_part(shape, "SIDES", "side"))
    for (int i = 0; i < slices; ++i) {
      add_triangle(surface, high[i], low[i], low[i + 1], 0);
      if (!cone) add_triangle(surface, high[i], low[i + 1], high[i + 1], 0);
    }
  high.pop_back();
  low.pop_back();
  if (!cone && has_part(shape, "TOP", "top")) add_fan(surface, high, state.by_parts ? 1 : 0);
  std::ranges::reverse(low);
  if (has_part(shape, "BOTTOM", "bottom"))
    add_fan(surface, low, state.by_parts ? (cone ? 1 : 2) : 0);
}

void cut_sphere(const InventorNode& shape, const InventorState& state, InventorSurface& surface) {
  const float radius = shape.number("radius"), pi = std::numbers::pi_v<float>;
  const int slices = slices_of(state.complexity, 30, 4),
            rows = slices_of(state.complexity, 30, 3) - 1;
  const float down = pi / static_cast<float>(rows), around = 2 * pi / static_cast<float>(slices);
  const InventorVector top = {0, radius, 0}, bottom = {0, -radius, 0};
  Ring above;
  float rho = down;
  for (int row = 1; row < rows; ++row, rho += down) {
    const float sine = std::sin(rho);
    Ring ring;
    float theta = 0;
    for (int i = 0; i <= slices; ++i, theta += around)
      ring.push_back({-std::sin(theta) * sine * radius, std::cos(rho) * radius,
                      -std::cos(theta) * sine * radius});
    if (row == 1) ring[0][0] = 0;  // not -0
    for (int i = 0; i < slices; ++i) {
      if (row == 1) {
        add_triangle(surface, top, ring[i], ring[i + 1], 0);
        continue;
      }
      add_triangle(surface, above[i], ring[i], ring[i + 1], 0);
      add_triangle(surface, above[i], ring[i + 1], above[i + 1], 0);
    }
    above = std::move(ring);
  }
  for (int i = 0; i < slices; ++i) add_triangle(surface, above[i], bottom, above[i + 1], 0);
}

// --- extrusions ---

InventorVector operator-(const InventorVector& a, const InventorVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
InventorVector operator*(float s, const InventorVector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
float dot(const InventorVector& a, const InventorVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
InventorVector cross(const InventorVector& a, const InventorVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// unit vector; zero if it is too short to have a direction
InventorVector unit(const InventorVector& a) {
  const float length = std::sqrt(dot(a, a));
  return length > 1e-20f ? (1.0f / length) * a : InventorVector{0, 0, 0};
}
bool is_zero(const InventorVector& a) { return a == InventorVector{0, 0, 0}; }

Ring vectors_of(std::span<const float> numbers) {
  Ring out;
  for (size_t i = 0; i < numbers.size(); i += 3)
    out.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return out;
}

/// Frames of the cross sections of an extrusion: y along the spine, z normal to the plane in which
/// it bends.   source  ISO/IEC 14772-1 (VRML 97), 6.18 Extrusion
struct SpineFrames {
  explicit SpineFrames(const Ring& spine);

  bool closed = false;
  Ring y, z;
};

SpineFrames::SpineFrames(const Ring& spine) : closed(spine.front() == spine.back()) {
  const size_t n = spine.size();
  closed = closed && n > 2;
  const auto before = [&](size_t i) { return i > 0 ? spine[i - 1] : spine[closed ? n - 2 : 0]; };
  const auto after = [&](size_t i) { return i + 1 < n ? spine[i + 1] : spine[closed ? 1 : n - 1]; };
  for (size_t i = 0; i < n; ++i) {
    y.push_back(unit(after(i) - before(i)));
    z.push_back(unit(cross(after(i) - spine[i], before(i) - spine[i])));
  }
  // straight parts keep the plane of the bend before them; before the first bend its plane is used
  const auto bend = std::ranges::find_if_not(z, is_zero);
  InventorVector last = {0, 0, 1};
  if (bend != z.end()) {
    last = *bend;
  } else if (const auto way = std::ranges::find_if_not(y, is_zero); way != y.end()) {
    // a straight spine: z is turned by the shortest rotation from y to the spine's direction
    InventorVector axis = cross({0, 1, 0}, *way);
    const float angle = std::atan2(std::sqrt(dot(axis, axis)), (*way)[1]);
    if (is_zero(axis)) axis = {0, 0, 1};
    last = InventorMatrix::rotation(std::array{axis[0], axis[1], axis[2], angle}).apply(last);
  }
  InventorVector way = {0, 1, 0};
  for (size_t i = 0; i < n; ++i) {
    if (is_zero(y[i])) y[i] = way;
    if (is_zero(z[i])) z[i] = last;
    if (dot(z[i], last) < 0) z[i] = -1.0f * z[i];
    way = y[i];
    last = z[i];
  }
}

/// The cross section at each point of the spine.
std::vector<Ring> extrusion_rings(const InventorNode& shape, const Ring& spine,
                                  const SpineFrames& frames) {
  const std::span<const float> section = shape.numbers("crossSection"),
                               scales = shape.numbers("scale"),
                               turns = shape.numbers("orientation");
  std::vector<Ring> out;
  for (size_t i = 0; i < spine.size(); ++i) {
    const auto at = [&](std::span<const float> list, size_t width) {
      return list.subspan(std::min(i, list.size() / width - 1) * width, width);
    };
    InventorMatrix X;
    const InventorVector x = cross(frames.y[i], frames.z[i]);
    const InventorVector* axes[] = {&x, &frames.y[i], &frames.z[i], &spine[i]};
    for (int r = 0; r < 4; ++r) std::ranges::copy(*axes[r], X.m[r].begin());
    if (!turns.empty()) X = InventorMatrix::rotation(at(turns, 4)) * X;
    Ring ring;
    for (size_t k = 0; k < section.size(); k += 2) {
      const float sx = scales.empty() ? 1 : at(scales, 2)[0],
                  sz = scales.empty() ? 1 : at(scales, 2)[1];
      ring.push_back(X.apply({section[k] * sx, 0, section[k + 1] * sz}));
    }
    out.push_back(std::move(ring));
  }
  return out;
}

void cut_extrusion(const InventorNode& shape, InventorSurface& surface) {
  const Ring spine = vectors_of(shape.numbers("spine"));
  const auto& section = shape.numbers("crossSection");
  surface.clockwise = !shape.integer("ccw");
  surface.convex = shape.integer("convex") != 0;
  if (spine.size() < 2 || section.size() < 4) return;
  if (spine.size() * section.size() > max_extrusion_points * 2)
    fail(
        "Extrusion: expected a spine and a cross section of at most {} points together, got {} x "
        "{}",
        max_extrusion_points, spine.size(), section.size() / 2);
  const SpineFrames frames(spine);
  std::vector<Ring> rings = extrusion_rings(shape, spine, frames);
  for (size_t i = 0; i + 1 < rings.size(); ++i)
    for (size_t k = 0; k + 1 < rings[i].size(); ++k) {
      add_triangle(surface, rings[i][k], rings[i][k + 1], rings[i + 1][k + 1], 0);
      add_triangle(surface, rings[i][k], rings[i + 1][k + 1], rings[i + 1][k], 0);
    }
  if (frames.closed) return;
  Ring &begin = rings.front(), &end = rings.back();
  for (Ring* cap : {&begin, &end})
    if (std::equal(section.begin(), section.begin() + 2, section.end() - 2)) cap->pop_back();
  std::reverse(begin.begin() + 1, begin.end());
  if (shape.integer("beginCap")) surface.add(begin, 0);
  if (shape.integer("endCap")) surface.add(end, 0);
}

}  // namespace

bool cut_shape(const InventorNode& shape, const InventorState& state, InventorSurface& surface) {
  switch (shape.type->kind) {
    case K::cube:
      cut_cube(shape, state, surface);
      return true;
    case K::sphere:
      cut_sphere(shape, state, surface);
      return true;
    case K::cylinder:
    case K::cone:
      cut_round(shape, state, surface);
      return true;
    case K::extrusion:
      cut_extrusion(shape, surface);
      return true;
    default:
      return false;
  }
}

}  // namespace clench
