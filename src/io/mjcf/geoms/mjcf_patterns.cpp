#include "clench/io/mjcf/geoms/mjcf_patterns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clench {

namespace {

// weight of the first color along a gradient, from 0 at -1 to 1 at 1
double sigmoid(double x) {
  return std::clamp(0.5 * (1 + std::numbers::sqrt2 * x / std::sqrt(1 + x * x)), 0.0, 1.0);
}

// x to the right and y up, both from -1 to 1
double gradient_share(int side, double x, double y) {
  if (side < 0) return 1 - sigmoid(2 * std::hypot(x, y) - 1);
  // by the elevation of a direction; y is up
  const double length = std::sqrt(1 + x * x + y * y), right_angle = std::numbers::pi / 2;
  if (side == 2) return sigmoid(1 - std::acos(1 / length) / right_angle);
  if (side == 3) return sigmoid(std::acos(1 / length) / right_angle - 1);
  return sigmoid(std::asin(y / length) / right_angle);
}

Eigen::Vector3d pattern_color(const MjcfPattern& pattern, int side, int column, int row) {
  if (pattern.kind == "flat") return side == 3 ? pattern.second : pattern.first;
  if (pattern.kind == "checker") {
    const bool right = column >= pattern.width / 2, low = row >= pattern.height / 2;
    return right == low ? pattern.first : pattern.second;
  }
  const double x = 2.0 * column / std::max(1, pattern.width - 1) - 1,
               y = 1 - 2.0 * row / std::max(1, pattern.height - 1);
  const double share = gradient_share(side, x, y);
  return share * pattern.first + (1 - share) * pattern.second;
}

bool is_marked(const MjcfPattern& pattern, int column, int row) {
  if (pattern.mark == "edge")
    return column == 0 || row == 0 || column == pattern.width - 1 || row == pattern.height - 1;
  return pattern.mark == "cross" && (column == pattern.width / 2 || row == pattern.height / 2);
}

}  // namespace

std::shared_ptr<const Image> pattern_image(const MjcfPattern& pattern, int side) {
  if (pattern.kind != "flat" && pattern.kind != "checker" && pattern.kind != "gradient")
    return nullptr;
  auto out = std::make_shared<Image>(Image{pattern.width, pattern.height});
  out->pixels.reserve(size_t{3} * pattern.width * pattern.height);
  for (int row = 0; row < pattern.height; ++row)
    for (int column = 0; column < pattern.width; ++column) {
      const Eigen::Vector3d color = is_marked(pattern, column, row)
                                        ? pattern.mark_color
                                        : pattern_color(pattern, side, column, row);
      for (const double part : color)
        out->pixels.push_back(static_cast<uint8_t>(std::lround(255 * part)));
    }
  return out;
}

}  // namespace clench
