// Pictures as values, and PNG files.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clench/scene/eye.h"

namespace clench {

struct Scene;

/// RGB, 8 bits a channel, rows from the top; and, where it lets through what it is laid on, how
/// much it covers.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;
  std::vector<uint8_t> alpha = {};  ///< one a pixel, 255 covers all; empty: all covers
  /// camera of a picture of a scene; empty: of a figure
  std::optional<Eye> eye = {};
  /// that it shows, for who picks in it; null: of a figure, or not kept
  std::shared_ptr<const Scene> scene = {};

  /// compares size and pixels
  bool operator==(const Picture& other) const {
    return width == other.width && height == other.height && pixels == other.pixels &&
           alpha == other.alpha;
  }
};

/// On white, all covered.
Picture on_white(const Picture& picture);

/// throws Error naming the path when it cannot be written
void save_png(const Picture& picture, const std::string& path);

}  // namespace clench
