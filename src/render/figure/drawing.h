// A figure as a list of lines, areas and texts, in pixels, to be painted or written as SVG.
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"

namespace clench {

/// Positions are in pixels, x to the right and y down, from the upper left corner; colors are
/// display (sRGB) values, each component in 0..1. Items are drawn over earlier ones.
struct Drawing {
  using Color = Eigen::Vector3f;
  /// with round ends and joints; a polyline of one point is a disc
  struct Line {
    std::vector<Eigen::Vector2f> points;
    float width;
    Color color;
  };
  struct Area {
    Eigen::Vector2f low, high;
    Color color;
  };
  struct Text {
    std::string text;    ///< UTF-8
    Eigen::Vector2f at;  ///< start of its baseline
    float height;        ///< height of capital letters
    Color color;
    bool upright = false;  ///< does it run upwards?
    bool rim = false;      ///< white, so that the text is legible on any background
  };
  using Item = std::variant<Line, Area, Text>;

  int width = 0, height = 0;
  std::vector<Item> items = {};
};

/// Paints the figure on white.
Picture paint(const Drawing& drawing, const Font& font);

/// The figure as SVG 1.1, with letters as text in the font of our pictures if the viewer has it.
std::string svg_text(const Drawing& drawing);

}  // namespace clench
