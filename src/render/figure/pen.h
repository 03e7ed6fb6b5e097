// Convenience functions that add items to a figure.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "clench/render/figure/drawing.h"

namespace clench {

struct Pen {
  Drawing& drawing;
  const Font& font;

  void rectangle(const Eigen::Vector2f& low, const Eigen::Vector2f& high,
                 const Drawing::Color& color) {
    drawing.items.push_back(Drawing::Area{low, high, color});
  }
  void line(std::vector<Eigen::Vector2f> points, float width, const Drawing::Color& color) {
    if (!points.empty()) drawing.items.push_back(Drawing::Line{std::move(points), width, color});
  }
  /// height  of capital letters, as everywhere [pixels]
  void text(const std::string& text, const Eigen::Vector2f& at, float height,
            const Drawing::Color& color, bool upright = false) {
    if (!text.empty()) drawing.items.push_back(Drawing::Text{text, at, height, color, upright});
  }
  /// with a white rim
  void bright_text(const std::string& text, const Eigen::Vector2f& at, float height,
                   const Drawing::Color& color) {
    drawing.items.push_back(Drawing::Text{text, at, height, color, false, true});
  }
};

}  // namespace clench
