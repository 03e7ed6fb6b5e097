// Layout of the words of a picture without overlaps.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "clench/render/figure/lettering.h"
#include "clench/scene/scene.h"

namespace clench {

/// A rectangle of a picture, in pixels from its upper left corner, y down.
struct PixelBox {
  Eigen::Vector2f low = Eigen::Vector2f::Zero(), high = Eigen::Vector2f::Zero();
  bool overlaps(const PixelBox& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
};

/// Boxes moved as little as necessary, earlier ones with priority, until each lies within the
/// picture and is clear of `taken` and of those before it. Empty for a box without a free position
/// within four of its heights up and down and eight sideways.
std::vector<std::optional<PixelBox>> spread_boxes(std::span<const PixelBox> expected,
                                                  const Eigen::Vector2f& picture,
                                                  std::vector<PixelBox> taken = {});

/// A text on a picture and its position: the text begins at the lower left corner of its box.
struct PlacedText {
  PixelBox box;
  std::string text;
  Eigen::Vector3f color;
  float height;  ///< height of capital letters [pixels]
};

/// The caption in the lower left corner, with lines broken to fit the width, and each label at its
/// projected position or next to it; labels behind the eye, out of the picture or without a free
/// position are left out. `letters`: height of all capital letters [pixels]; 0: a fraction of the
/// picture's. Pictures of less than 120 pixels in either direction have no text.
std::vector<PlacedText> place_texts(const Scene& scene, const Eye& eye,
                                    const Eigen::Vector2f& picture, const Font& font,
                                    float letters = 0);

}  // namespace clench
