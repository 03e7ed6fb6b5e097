// Lines, areas and letters on a picture, with smooth edges; drawn without graphics hardware.
#pragma once
#include <Eigen/Core>
#include <string_view>

#include "clench/render/figure/lettering.h"
#include "clench/render/figure/picture.h"

namespace clench {

/// Draws on a picture and by a font that it does not own. Places are in pixels, x to the right and
/// y down, from the upper left corner; what lies outside is cut off. Colors are as a screen shows
/// them, each part in 0..1.
class Canvas {
 public:
  using Color = Eigen::Vector3f;
  Canvas(Picture& picture, const Font& font) : picture_(picture), font_(font) {}

  const Font& font() const { return font_; }

  void rectangle(const Eigen::Vector2f& low, const Eigen::Vector2f& high, const Color& color);
  /// with round ends; one point to itself is a disc
  void line(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float width,
            const Color& color);
  void text(const TextLine& line, const Color& color);
  /// with a white rim, to be read on anything
  void bright_text(const TextLine& line, const Color& color);

 private:
  void blend(int x, int y, float part, const Color& color);
  Picture& picture_;
  const Font& font_;
};

/// White, of a size in pixels.
Picture blank_picture(int width, int height);

}  // namespace clench
