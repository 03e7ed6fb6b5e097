#include "clench/render/picture.h"

#include <png.h>

#include <string_view>

#include "clench/base/error.h"
#include "clench/base/file.h"

namespace clench {

void save_png(const Picture& picture, const std::string& path) {
  if (picture.width < 1 || picture.height < 1 ||
      picture.pixels.size() != 3 * static_cast<size_t>(picture.width) * picture.height)
    fail("cannot write '{}': a picture of {} x {} pixels wants {} bytes, got {}", path,
         picture.width, picture.height, 3LL * picture.width * picture.height,
         picture.pixels.size());
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = PNG_FORMAT_RGB;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr))
    fail("cannot write '{}': {}", path, image.message);
  write_file(path, std::string_view(bytes).substr(0, size));
}

}  // namespace clench
