#include "clench/render/mesh/corner.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "clench/base/convert.h"

namespace clench {

Eigen::Vector3f linear_rgb(const Eigen::Vector3f& color) {
  return color.unaryExpr(
      [](float x) { return 0.012f + 0.988f * std::pow(std::min(std::max(x, 0.0f), 1.0f), 2.2f); });
}

Paint make_paint(const Eigen::Vector3f& color, float opacity) {
  const auto part = [](float x) {
    return static_cast<uint16_t>(floor_between(65535 * double{x} + 0.5, 0, 65535));
  };
  const Eigen::Vector3f light = linear_rgb(color);
  return {part(light[0]), part(light[1]), part(light[2]), part(opacity)};
}

Paint paint_of_place(const Eigen::Vector2f& uv) {
  return std::bit_cast<Paint>(std::array<float, 2>{uv.x(), uv.y()});
}

Eigen::Vector2f place_of_paint(const Paint& paint) {
  const auto uv = std::bit_cast<std::array<float, 2>>(paint);
  return {uv[0], uv[1]};
}

}  // namespace clench
