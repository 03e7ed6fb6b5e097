#include "clench/render/mesh/pieces.h"

#include <cmath>
#include <numbers>

#include "clench/base/error.h"
#include "clench/render/mesh/outward.h"

namespace clench {
namespace {

constexpr int cone_sides = 40;
constexpr int dot_sides = 12, dot_rings = 6;
constexpr int arrow_sides = 24;
constexpr double head_width = 3, head_length = 7;  // in radii of the rod

// widest part of a cone; one without an angle is drawn as a needle, a wide one is truncated
double cone_radius(const DrawCone& c) {
  return c.height * std::clamp(std::tan(c.half_angle), 0.06, 3.0);
}

void check_skin(const Skin& skin, size_t triangles, size_t number) {
  if (skin.triangles.size() != triangles)
    fail("picture: mesh {}: expected places in images for each of {} triangles, got {}", number,
         triangles, skin.triangles.size());
  for (const Texture& texture : skin.textures)
    if (!texture.image || texture.image->pixels.empty())
      fail("picture: mesh {}: expected textures to have images", number);
  for (const TexturedTriangle& triangle : skin.triangles)
    if (triangle.texture < -1 || triangle.texture >= static_cast<int>(skin.textures.size()))
      fail("picture: mesh {}: expected one of {} textures, got {}", number, skin.textures.size(),
           triangle.texture);
}

}  // namespace

TextureOrder::TextureOrder(size_t count, const SkinPtr& skin) {
  counts.resize(skin ? skin->textures.size() + 1 : 1);
  const auto group = [&](size_t i) {
    return skin ? static_cast<size_t>(skin->triangles[i].texture + 1) : 0;
  };
  for (size_t i = 0; i < count; ++i) ++counts[group(i)];
  std::vector<size_t> next(counts.size(), 0);
  for (size_t g = 1; g < counts.size(); ++g) next[g] = next[g - 1] + counts[g - 1];
  triangles.resize(count);
  for (size_t i = 0; i < count; ++i) triangles[next[group(i)]++] = static_cast<int>(i);
}

void check(const Scene& scene) {
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    const DrawMesh& m = scene.meshes[i];
    if (!m.X_WM.is_finite()) fail("picture: mesh {}: pose must be finite numbers", i + 1);
    if (!(m.opacity >= 0 && m.opacity <= 1))
      fail("picture: mesh {}: opacity must be between 0 and 1, got {}", i + 1, m.opacity);
    if (!m.color.allFinite()) fail("picture: mesh {}: color must be finite numbers", i + 1);
    if (m.shape && m.skin) check_skin(*m.skin, m.shape->mesh().triangles.size(), i + 1);
    if (!m.shape || m.triangle_colors.empty()) continue;
    if (m.triangle_colors.size() != m.shape->mesh().triangles.size())
      fail("picture: mesh {}: expected one color for each of {} triangles, got {}", i + 1,
           m.shape->mesh().triangles.size(), m.triangle_colors.size());
    for (const auto& color : m.triangle_colors)
      if (!color.allFinite())
        fail("picture: mesh {}: triangle colors must be finite numbers", i + 1);
  }
  for (size_t i = 0; i < scene.cones.size(); ++i) {
    const DrawCone& c = scene.cones[i];
    if (!c.apex.allFinite() || !c.color.allFinite())
      fail("picture: cone {}: apex and color must be finite numbers", i + 1);
    if (!(std::abs(c.axis.norm() - 1) < 1e-6))
      fail("picture: cone {}: axis must have length 1", i + 1);
    if (!(c.half_angle >= 0 && c.half_angle < std::numbers::pi / 2))
      fail("picture: cone {}: half angle must be at least 0 and less than pi/2, got {}", i + 1,
           c.half_angle);
    if (!(c.height >= 0 && std::isfinite(c.height)))
      fail("picture: cone {}: height must be >= 0, got {} [m]", i + 1, c.height);
  }
  for (size_t i = 0; i < scene.arrows.size(); ++i) {
    const DrawArrow& a = scene.arrows[i];
    if (!a.tail.allFinite() || !a.tip.allFinite() || !a.color.allFinite())
      fail("picture: arrow {}: tail, tip and color must be finite numbers", i + 1);
    if (!(a.radius > 0 && std::isfinite(a.radius)))
      fail("picture: arrow {}: radius must be > 0, got {} [m]", i + 1, a.radius);
  }
  for (size_t i = 0; i < scene.labels.size(); ++i)
    if (!scene.labels[i].p_W.allFinite() || !scene.labels[i].color.allFinite())
      fail("picture: label {}: place and color must be finite numbers", i + 1);
  if (scene.ground && !std::isfinite(*scene.ground))
    fail("picture: height of the ground must be a finite number");
}

Piece mesh_piece(const DrawMesh& m, size_t number) {
  Piece piece{.triangles = m.shape->mesh().triangles,
              .colors = m.triangle_colors,
              .skin = m.skin,
              .opacity = m.opacity,
              .background = m.background,
              .closed = faces_outward(*m.shape)};
  if (piece.colors.empty()) piece.colors = {m.color};
  piece.p_W.reserve(m.shape->mesh().vertices.size());
  for (const auto& p : m.shape->mesh().vertices) {
    piece.p_W.push_back(m.X_WM * p);
    if (!piece.p_W.back().allFinite())
      fail("picture: mesh {}: position exceeds the range of numbers", number);
  }
  return piece;
}

Piece cone_piece(const DrawCone& c) {
  Piece piece{.colors = {c.color}, .opacity = 0.85f, .mark = true};
  const Eigen::Vector3d side = c.axis.unitOrthogonal(), other = c.axis.cross(side);
  const auto around = [&](int i, int sides) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * i / sides;
    return std::cos(angle) * side + std::sin(angle) * other;
  };
  const double radius = cone_radius(c);
  const Eigen::Vector3d end = c.apex + c.height * c.axis;
  piece.p_W = {c.apex, end};
  for (int i = 0; i < cone_sides; ++i) piece.p_W.push_back(end + radius * around(i, cone_sides));
  for (int i = 0; i < cone_sides; ++i) {
    const int a = 2 + i, b = 2 + (i + 1) % cone_sides;
    piece.triangles.push_back({0, b, a});
    piece.triangles.push_back({1, a, b});
  }
  const int first = static_cast<int>(piece.p_W.size());
  for (int r = 0; r <= dot_rings; ++r)
    for (int i = 0; i < dot_sides; ++i) {
      const double polar = std::numbers::pi * r / dot_rings;
      piece.p_W.push_back(c.apex +
                          0.10 * c.height *
                              (std::cos(polar) * c.axis + std::sin(polar) * around(i, dot_sides)));
    }
  for (int r = 0; r < dot_rings; ++r)
    for (int i = 0; i < dot_sides; ++i) {
      const int a = first + r * dot_sides + i, b = first + r * dot_sides + (i + 1) % dot_sides;
      piece.triangles.push_back({a, a + dot_sides, b});
      piece.triangles.push_back({b, a + dot_sides, b + dot_sides});
    }
  return piece;
}

Piece arrow_piece(const DrawArrow& arrow) {
  Piece piece{.colors = {arrow.color}, .opacity = 0.95f, .mark = true};
  const double length = (arrow.tip - arrow.tail).norm();
  if (length == 0) return piece;
  const Eigen::Vector3d axis = (arrow.tip - arrow.tail) / length;
  const Eigen::Vector3d side = axis.unitOrthogonal(), other = axis.cross(side);
  const double head = std::min(head_length * arrow.radius, 0.5 * length);

  // rings from the tail on: the rod's ends, then the head's base; the tip is a ring of radius 0
  const struct {
    double along, radius;
  } rings[] = {{0, 0},
               {0, arrow.radius},
               {length - head, arrow.radius},
               {length - head, head_width / head_length * head},
               {length, 0}};
  for (const auto& ring : rings)
    for (int i = 0; i < arrow_sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / arrow_sides;
      piece.p_W.push_back(arrow.tail + ring.along * axis +
                          ring.radius * (std::cos(angle) * side + std::sin(angle) * other));
    }
  for (int r = 0; r + 1 < static_cast<int>(std::size(rings)); ++r)
    for (int i = 0; i < arrow_sides; ++i) {
      const int a = r * arrow_sides + i, b = r * arrow_sides + (i + 1) % arrow_sides;
      if (rings[r].radius > 0) piece.triangles.push_back({a, b, b + arrow_sides});
      if (rings[r + 1].radius > 0) piece.triangles.push_back({a, b + arrow_sides, a + arrow_sides});
    }
  return piece;
}

}  // namespace clench
