// Corners of triangles as the graphics card takes them.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace clench {

/// Red green blue, as a surface of this color returns light, and opacity: parts of 65535.
using Paint = std::array<uint16_t, 4>;

/// One corner of triangles as the shaders read it.
struct Corner {
  Eigen::Vector3f p;  ///< scene units
  Eigen::Vector3f n;  ///< unit, to the side from which the triangle runs counter-clockwise
  Paint paint;        ///< of a triangle with an image: its place there, by paint_of_place
};
static_assert(sizeof(Corner) == 32);

/// The part of light that a surface returns whose color on a screen is this, 0..1. Nothing is so
/// black that its shape is lost.
Eigen::Vector3f linear_rgb(const Eigen::Vector3f& color);

/// color: as on a screen
Paint make_paint(const Eigen::Vector3f& color, float opacity);

/// A place in an image, as two 32-bit numbers in the bytes of a paint, and back.
Paint paint_of_place(const Eigen::Vector2f& uv);
Eigen::Vector2f place_of_paint(const Paint& paint);

}  // namespace clench
