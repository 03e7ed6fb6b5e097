#include "clench/render/figure/picture.h"

#include <png.h>

#include <string_view>

#include "clench/base/error.h"
#include "clench/base/file.h"

namespace clench {

void save_png(const Picture& picture, const std::string& path) {
  if (picture.width < 1 || picture.height < 1 ||
      picture.pixels.size() != 3 * static_cast<size_t>(picture.width) * picture.height)
    fail("cannot write '{}': a picture of {} x {} pixels needs {} bytes, got {}", path,
         picture.width, picture.height, 3LL * picture.width * picture.height,
         picture.pixels.size());
  const size_t count = static_cast<size_t>(picture.width) * picture.height;
  if (!picture.alpha.empty() && picture.alpha.size() != count)
    fail("cannot write '{}': expected {} bytes of alpha, got {}", path, count,
         picture.alpha.size());
  std::vector<uint8_t> mixed;
  for (size_t i = 0; i < picture.alpha.size(); ++i) {
    mixed.insert(mixed.end(), &picture.pixels[3 * i], &picture.pixels[3 * i] + 3);
    mixed.push_back(picture.alpha[i]);
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = mixed.empty() ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0,
                                 mixed.empty() ? picture.pixels.data() : mixed.data(), 0, nullptr))
    fail("cannot write '{}': {}", path, image.message);
  write_file(path, std::string_view(bytes).substr(0, size));
}

}  // namespace clench
