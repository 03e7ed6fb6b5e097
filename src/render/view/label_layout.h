// Where the words of a picture go, so that none lie over each other.
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

/// Boxes moved as little as need be, the first the least, until each lies within the picture and
/// clear of `taken` and of those before it. Empty for one that finds no place within four of its
/// heights up and down and eight sideways.
std::vector<std::optional<PixelBox>> spread_boxes(std::span<const PixelBox> expected,
                                                  const Eigen::Vector2f& picture,
                                                  std::vector<PixelBox> taken = {});

/// What is written on a picture, and where: the text begins at the lower left corner of its box.
struct PlacedText {
  PixelBox box;
  std::string text;
  Eigen::Vector3f color;
  float height;  ///< of capital letters [pixels]
};

/// The caption in the lower left corner, its lines broken where they are too wide, and each label
/// at its place as the eye sees it, or next to it; those behind the eye, out of the picture or
/// without room are left out. `letters`: height of all capital letters [pixels]; 0: a part of the
/// picture's. Nothing is written on pictures of less than 120 pixels either way.
std::vector<PlacedText> place_texts(const Scene& scene, const Eye& eye,
                                    const Eigen::Vector2f& picture, const Font& font,
                                    float letters = 0);

}  // namespace clench
