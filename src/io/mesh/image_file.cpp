#include "clench/io/mesh/image_file.h"

#include <jpeglib.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>

#include "clench/base/error.h"

namespace clench {
namespace {

void check_size(int64_t width, int64_t height, const std::string& name, ImageBudget* budget) {
  if (width < 1 || height < 1 || width * height > max_image_pixels)
    fail("{}: expected an image of 1 to {} pixels, got {} x {}", name, max_image_pixels, width,
         height);
  if (budget) budget->add(width, height, name);
}

Image decode_png(const std::string& bytes, const std::string& name, ImageBudget* budget) {
  png_image head{};
  head.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&head, bytes.data(), bytes.size()))
    fail("{}: {}", name, head.message);
  try {
    check_size(head.width, head.height, name, budget);
  } catch (const Error&) {
    png_image_free(&head);
    throw;
  }
  head.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(head.width), static_cast<int>(head.height), {}};
  image.pixels.resize(PNG_IMAGE_SIZE(head));
  const png_color white{255, 255, 255};
  if (!png_image_finish_read(&head, &white, image.pixels.data(), 0, nullptr))
    fail("{}: {}", name, head.message);
  return image;
}

// on errors libjpeg jumps back into the active read_head or read_rows
struct JpegErrors {
  jpeg_error_mgr base;
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX];
};

[[noreturn]] void leave_jpeg(j_common_ptr info) {
  auto* errors = reinterpret_cast<JpegErrors*>(info->err);
  errors->base.format_message(info, errors->message);
  std::longjmp(errors->back, 1);
}

// decodes row by row into memory of the caller, which survives a jump; false: errors.message is set
struct JpegDecoder {
  jpeg_decompress_struct info = {};
  JpegErrors errors = {};

  JpegDecoder() {
    info.err = jpeg_std_error(&errors.base);
    errors.base.error_exit = leave_jpeg;
    errors.base.output_message = [](j_common_ptr) {};
  }
  ~JpegDecoder() { jpeg_destroy_decompress(&info); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  bool read_head(const std::string& bytes) {
    if (setjmp(errors.back)) return false;
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&info, TRUE);
    info.out_color_space = JCS_RGB;
    return true;
  }
  bool read_rows(uint8_t* pixels) {
    if (setjmp(errors.back)) return false;
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
      JSAMPROW row = pixels + size_t{3} * info.output_width * info.output_scanline;
      jpeg_read_scanlines(&info, &row, 1);
    }
    jpeg_finish_decompress(&info);
    return true;
  }
};

Image decode_jpeg(const std::string& bytes, const std::string& name, ImageBudget* budget) {
  JpegDecoder decoder;
  if (!decoder.read_head(bytes)) fail("{}: {}", name, decoder.errors.message);
  check_size(decoder.info.image_width, decoder.info.image_height, name, budget);
  Image image{
      static_cast<int>(decoder.info.image_width), static_cast<int>(decoder.info.image_height), {}};
  image.pixels.resize(size_t{3} * image.width * image.height);
  if (!decoder.read_rows(image.pixels.data())) fail("{}: {}", name, decoder.errors.message);
  // libjpeg fills the missing rows of a truncated file with gray and only warns
  if (decoder.errors.base.num_warnings > 0) fail("{}: the image is damaged or cut short", name);
  return image;
}

Eigen::Vector3f color_at(const Image& image, const Eigen::Vector2d& uv) {
  const auto wrapped = [](double x, int count) {
    const double part = x - std::floor(x);  // in [0, 1]; rounding may give 1
    return std::min(static_cast<int>(part * count), count - 1);
  };
  const size_t x = static_cast<size_t>(wrapped(uv.x(), image.width)),
               y = static_cast<size_t>(wrapped(uv.y(), image.height));
  const uint8_t* p = &image.pixels[3 * (y * image.width + x)];
  return Eigen::Vector3f(p[0], p[1], p[2]) / 255;
}

}  // namespace

void ImageBudget::add(int64_t width, int64_t height, const std::string& name) {
  if (pixels_ + width * height > 2 * max_image_pixels)
    fail(ErrorKind::limit, "{}: expected images of at most {} pixels in all", name,
         2 * max_image_pixels);
  pixels_ += width * height;
}

Image decode_image(const std::string& bytes, const std::string& name, ImageBudget* budget) {
  if (bytes.starts_with("\x89PNG")) return decode_png(bytes, name, budget);
  if (bytes.starts_with("\xFF\xD8\xFF")) return decode_jpeg(bytes, name, budget);
  fail("{}: expected an image in the format PNG or JPEG", name);
}

std::string encode_as_jpeg(const Image& image, int quality) {
  jpeg_compress_struct info = {};
  jpeg_error_mgr errors = {};
  info.err = jpeg_std_error(&errors);  // fails only for lack of memory or wrong calls
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
  jpeg_mem_dest(&info, &bytes, &count);
  info.image_width = static_cast<JDIMENSION>(image.width);
  info.image_height = static_cast<JDIMENSION>(image.height);
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, quality, TRUE);
  jpeg_start_compress(&info, TRUE);
  std::vector<uint8_t> row(size_t{3} * image.width);
  while (info.next_scanline < info.image_height) {
    std::copy_n(image.pixels.begin() + static_cast<long>(row.size()) * info.next_scanline,
                row.size(), row.begin());
    JSAMPROW at = row.data();
    jpeg_write_scanlines(&info, &at, 1);
  }
  jpeg_finish_compress(&info);
  std::string out(reinterpret_cast<const char*>(bytes), count);
  jpeg_destroy_compress(&info);
  std::free(bytes);
  return out;
}

Eigen::Vector3f mean_color(const Image& image, std::span<const Eigen::Vector2d> corners) {
  constexpr int steps = 6;  // per side of a triangle
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  int count = 0;
  // sample the centroids of small parts of each triangle of the fan: parts with its orientation
  // first, then the reversed ones
  for (size_t k = 1; k + 1 < corners.size(); ++k)
    for (const double middle : {1.0 / 3, 2.0 / 3})
      for (int i = 0; i < steps; ++i)
        for (int j = 0; i + j < (middle < 0.5 ? steps : steps - 1); ++j) {
          const double a = (i + middle) / steps, b = (j + middle) / steps;
          sum += color_at(image, corners[0] + a * (corners[k] - corners[0]) +
                                     b * (corners[k + 1] - corners[0]));
          ++count;
        }
  return sum / static_cast<float>(count);
}

}  // namespace clench
