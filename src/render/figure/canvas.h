// Anti-aliased lines, areas and letters on a picture, drawn without graphics hardware.
#pragma once
#include <Eigen/Core>
#include <string_view>

#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"

namespace clench {

/// Draws on a picture with a font; it owns neither. Positions are in pixels, x to the right and y
/// down, from the upper left corner; drawing is clipped to the picture. Colors are in display
/// (sRGB) values, each component in 0..1.
class Canvas {
 public:
  using Color = Eigen::Vector3f;
  Canvas(Picture& picture, const Font& font) : picture_(picture), font_(font) {}

  const Font& font() const { return font_; }

  void rectangle(const Eigen::Vector2f& low, const Eigen::Vector2f& high, const Color& color);
  /// with round ends; a polyline of one point is a disc
  void line(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float width,
            const Color& color);
  void text(const TextLine& line, const Color& color);
  /// with a white rim, legible on any background
  void bright_text(const TextLine& line, const Color& color);

 private:
  void blend(int x, int y, float part, const Color& color);
  Picture& picture_;
  const Font& font_;
};

/// White, of the given size in pixels.
Picture blank_picture(int width, int height);

}  // namespace clench
