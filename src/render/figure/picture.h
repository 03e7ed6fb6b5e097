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

/// RGB, 8 bits per channel, rows from the top; transparent pictures also have an alpha channel.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;
  std::vector<uint8_t> alpha = {};  ///< one per pixel, 255 is opaque; empty: all pixels are opaque
  /// camera of a picture of a scene; empty for a figure
  std::optional<Eye> eye = {};
  /// the scene that it shows, used for picking; null for a figure, or if not kept
  std::shared_ptr<const Scene> scene = {};

  /// compares size and pixels
  bool operator==(const Picture& other) const {
    return width == other.width && height == other.height && pixels == other.pixels &&
           alpha == other.alpha;
  }
};

/// The picture on white, fully opaque.
Picture on_white(const Picture& picture);

/// throws Error naming the path if it cannot be written
void save_png(const Picture& picture, const std::string& path);

}  // namespace clench
