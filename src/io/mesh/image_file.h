// Texture images: PNG and JPEG.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>

#include "clench/spec/skin.h"

namespace clench {

/// Largest image that is decoded [pixels].
inline constexpr int64_t max_image_pixels = int64_t{1} << 26;

/// Limits the memory used by the images of one file.
class ImageBudget {
 public:
  /// Adds an image of that size [pixels] to the total.
  /// throws  Error if all images together have more than twice max_image_pixels
  void add(int64_t width, int64_t height, const std::string& name);

 private:
  int64_t pixels_ = 0;
};

/// Decodes a PNG or JPEG file; its first bytes determine the format. Transparent pixels are blended
/// with white. Its size is checked, and added to the budget, before memory for it is allocated.
/// throws  Error "NAME: ..." if it has another format, is malformed, truncated or too large
Image decode_image(const std::string& bytes, const std::string& name,
                   ImageBudget* budget = nullptr);

/// Encodes the image as JPEG; quality 1 to 100.
std::string encode_as_jpeg(const Image& image, int quality);

/// Mean color of an image over a triangle or polygon of texture coordinates. The image is repeated
/// outside [0, 1]; u to the right, v down from the top.
/// corners  at least 3, finite
Eigen::Vector3f mean_color(const Image& image, std::span<const Eigen::Vector2d> corners);

}  // namespace clench
