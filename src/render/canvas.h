// Lines, areas and letters on a picture, with smooth edges; drawn without graphics hardware.
#pragma once
#include <Eigen/Core>
#include <string>
#include <string_view>

#include "render/picture.h"

namespace clench {

/// Draws on a picture that it does not own. Places are in pixels, x to the right and y down, from
/// the upper left corner; what lies outside is cut off. Colours are as a screen shows them, each
/// part in 0..1.
class Canvas {
 public:
  using Color = Eigen::Vector3f;
  explicit Canvas(Picture& picture) : picture_(picture) {}

  void fill(const Color& color);
  void rectangle(const Eigen::Vector2f& low, const Eigen::Vector2f& high, const Color& color);
  /// with round ends; one point to itself is a disc
  void line(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float width,
            const Color& color);
  /// `height` of capital letters; the text begins at `at`, on its baseline, and runs along a unit
  /// vector; words are UTF-8
  void text(std::string_view words, const Eigen::Vector2f& at, float height, const Color& color,
            const Eigen::Vector2f& along = Eigen::Vector2f::UnitX());
  /// with a white rim, to be read on anything
  void bright_text(std::string_view words, const Eigen::Vector2f& at, float height,
                   const Color& color);
  /// width that `words` take [pixels]
  static float text_width(std::string_view words, float height);
  /// the words, or their beginning and end about an ellipsis, so that they take no more than this
  /// width [pixels]; nothing where even that is too narrow
  static std::string shortened(std::string_view words, float height, float width);

 private:
  void blend(int x, int y, float part, const Color& color);
  Picture& picture_;
};

/// White, of a size in pixels.
Picture blank_picture(int width, int height);

}  // namespace clench
