// A figure as lines, areas and texts, in pixels: painted, or written as SVG.
#pragma once
#include <string>
#include <variant>
#include <vector>

#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"

namespace clench {

/// Places are in pixels, x to the right and y down, from the upper left corner; colors are as a
/// screen shows them, each part in 0..1. Items lie over those before them.
struct Drawing {
  using Color = Eigen::Vector3f;
  /// with round ends and joints; one point is a disc
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
    Eigen::Vector2f at;  ///< where its baseline begins
    float height;        ///< of capital letters
    Color color;
    bool upright = false;  ///< it runs upwards
    bool rim = false;      ///< a white one, to be read on anything
  };
  using Item = std::variant<Line, Area, Text>;

  int width = 0, height = 0;
  std::vector<Item> items = {};
};

/// On white.
Picture paint(const Drawing& drawing, const Font& font);

/// As SVG 1.1, letters as text in the font of our pictures where a viewer has it.
std::string svg_text(const Drawing& drawing);

}  // namespace clench
