#include "render/picture.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/error.h"

namespace clench {

void save_png(const Picture& picture, const std::string& path) {
  if (picture.width < 1 || picture.height < 1 ||
      picture.pixels.size() != 3 * static_cast<size_t>(picture.width) * picture.height)
    fail("cannot write '{}': a picture of {} x {} pixels wants {} bytes, got {}", path,
         picture.width, picture.height, 3LL * picture.width * picture.height,
         picture.pixels.size());
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) fail("cannot write '{}': {}", path, std::strerror(errno));

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = PNG_FORMAT_RGB;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  const bool written =
      png_image_write_to_stdio(&image, file, 0, picture.pixels.data(), 0, nullptr) != 0;
  // a full disk may show only now
  const bool closed = std::fclose(file) == 0;
  if (!written) fail("cannot write '{}': {}", path, image.message);
  if (!closed) fail("cannot write '{}': {}", path, std::strerror(errno));
}

}  // namespace clench
