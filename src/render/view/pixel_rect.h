// Rectangles of pixels in a picture.
#pragma once
#include <span>
#include <vector>

namespace clench {

/// From its lower left corner [pixels].
struct PixelRect {
  int x = 0, y = 0, width = 0, height = 0;

  bool contains(const PixelRect& other) const {
    return other.x >= x && other.y >= y && other.x + other.width <= x + width &&
           other.y + other.height <= y + height;
  }
  /// The rectangle without a margin; empty if nothing is left.
  PixelRect without(int margin) const {
    const int w = width - 2 * margin, h = height - 2 * margin;
    if (w <= 0 || h <= 0) return {};
    return {x + margin, y + margin, w, h};
  }
  bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const PixelRect&) const = default;
};

/// Disjoint rectangles that consist of the pixels of `whole` outside of all `covered` ones.
std::vector<PixelRect> uncovered(const PixelRect& whole, std::span<const PixelRect> covered);

}  // namespace clench
