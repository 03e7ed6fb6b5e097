// Triangle corners in the layout of the graphics card.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace clench {

/// Red green blue, as linear reflectance, and opacity: 16-bit fractions of 65535.
using Paint = std::array<uint16_t, 4>;

/// One corner of triangles as the shaders read it.
struct Corner {
  Eigen::Vector3f p;  ///< scene units
  Eigen::Vector3f n;  ///< unit, on the side from which the triangle runs counter-clockwise
  Paint paint;        ///< color; for a textured triangle the image coordinates, by paint_of_place
};
static_assert(sizeof(Corner) == 32);

/// Reflectance of a surface whose color on a screen is this, 0..1. Black is slightly brightened, so
/// that its shape stays visible.
Eigen::Vector3f linear_rgb(const Eigen::Vector3f& color);

/// color: display values
Paint make_paint(const Eigen::Vector3f& color, float opacity);

/// Image coordinates stored as two 32-bit numbers in the bytes of a paint, and their inverse.
Paint paint_of_place(const Eigen::Vector2f& uv);
Eigen::Vector2f place_of_paint(const Paint& paint);

}  // namespace clench
