#include "clench/render/paint/tile.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "clench/base/error.h"
#include "clench/render/mesh/draw_list.h"
#include "clench/render/view/frame.h"

namespace clench {

namespace {

constexpr int largest_tile = 1536;  // [pixels]

}  // namespace

std::vector<Tile> tiles_of(const RenderOptions& options) {
  std::vector<Tile> out;
  const bool one = options.width <= largest_tile && options.height <= largest_tile;
  const int border = one ? 0 : static_cast<int>(std::ceil(options.outline / 2 + 1));
  for (int y = 0; y < options.height; y += largest_tile)
    for (int x = 0; x < options.width; x += largest_tile)
      out.push_back({x, y, std::min(largest_tile, options.width - x),
                     std::min(largest_tile, options.height - y), options.outline > 0 ? border : 0});
  return out;
}

Eigen::Matrix4d crop_to(const Tile& tile, const RenderOptions& options,
                        const Eigen::Vector2d& shift) {
  const int x = tile.x - tile.border, y = tile.y - tile.border, width = tile.drawn_width(),
            height = tile.drawn_height();
  Eigen::Matrix4d crop = Eigen::Matrix4d::Identity();
  crop(0, 0) = static_cast<double>(options.width) / width;
  crop(1, 1) = static_cast<double>(options.height) / height;
  crop(0, 3) = (options.width - 2 * x - width + 2 * shift.x()) / width;
  crop(1, 3) = (options.height - 2 * y - height + 2 * shift.y()) / height;
  return crop;
}

// everything is within a ball around the origin; the near plane is as close as that allows
Eigen::Vector2d depth_range(const Eye& eye) {
  const double distance = eye.eye.norm(), ball = 2 * floor_reach;
  const double far = distance + ball;
  if (eye.ortho_height > 0) return {-far, far};
  return {std::max({5e-4, std::min(0.5 * (distance - 1), 0.02 * distance), distance - ball}), far};
}

Eigen::Vector3f shading_eye(const Eye& eye) {
  constexpr double far = 1e4;
  if (eye.ortho_height == 0) return eye.eye.cast<float>();
  return (eye.target + far * view_axes(eye).col(2)).cast<float>();
}

void read_tile(const Tile& tile, Picture& out, const Eigen::Vector2i& first) {
  std::vector<uint8_t> pixels(4 * static_cast<size_t>(tile.width) * tile.height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(first.x() + tile.border, first.y() + tile.border, tile.width, tile.height, GL_RGBA,
               GL_UNSIGNED_BYTE, pixels.data());
  // reverses the order of rows, to begin at the top
  for (int y = 0; y < tile.height; ++y) {
    const size_t row = out.height - 1 - tile.y - y, start = row * out.width + tile.x;
    const uint8_t* from = &pixels[4 * static_cast<size_t>(y) * tile.width];
    uint8_t* to = &out.pixels[3 * start];
    for (int x = 0; x < tile.width; ++x, from += 4, to += 3) {
      to[0] = from[0], to[1] = from[1], to[2] = from[2];
      if (!out.alpha.empty()) out.alpha[start + x] = from[3];
    }
  }
}

int map_size_for(const RenderOptions& options, int min_size, int max_size) {
  int size = min_size;
  while (size < max_size && 5 * size < 4 * std::max(options.width, options.height)) size *= 2;
  return size;
}

void check_driver() {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    fail(ErrorKind::internal, "picture: the OpenGL driver reports error {:#x}", error);
}

Picture empty_picture(const RenderOptions& options) {
  Picture out{options.width, options.height, {}};
  const size_t count = static_cast<size_t>(out.width) * out.height;
  out.pixels.resize(3 * count);
  if (options.backdrop != Backdrop::studio) out.alpha.resize(count);
  return out;
}

}  // namespace clench
