// Texture images: PNG and JPEG.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace clench {

/// RGB, 8 bits per channel, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> pixels;
};

/// Largest image that is decoded [pixels].
inline constexpr int64_t max_image_pixels = int64_t{1} << 26;

/// Bounds the memory that the images of one file take.
class ImageBudget {
 public:
  /// Adds an image to the total.
  /// throws  Error when all images together have more than twice max_image_pixels
  void add(const Image& image, const std::string& name);

 private:
  int64_t pixels_ = 0;
};

/// Decodes a PNG or JPEG file; its first bytes determine the format. Transparent pixels are blended
/// with white.
/// throws  Error "NAME: ..." when it has another format, is malformed, truncated or too large
Image decode_image(const std::string& bytes, const std::string& name);

/// Mean color of an image over a triangle or polygon of texture coordinates, repeated beyond
/// [0, 1]: u to the right, v down from the top.
/// corners  at least 3, finite
Eigen::Vector3f mean_color(const Image& image, std::span<const Eigen::Vector2d> corners);

}  // namespace clench
