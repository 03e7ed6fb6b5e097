#include "clench/render/figure/picture.h"

#include <png.h>

#include <filesystem>

#include "clench/base/error.h"

using namespace clench;

namespace {

Picture pattern(int width, int height) {
  Picture picture{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    picture.pixels.push_back(static_cast<uint8_t>(i * i + 7 * i));
  return picture;
}

Picture read_png(const std::string& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&image, path.c_str()));
  CHECK(image.format == PNG_FORMAT_RGB);
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.pixels.resize(PNG_IMAGE_SIZE(image));
  REQUIRE(png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr));
  return picture;
}

}  // namespace

TEST_CASE("a PNG file read back equals the picture that was saved") {
  const auto path = std::filesystem::temp_directory_path() / "clench_picture_test.png";
  for (const auto& [w, h] : {std::pair(1, 1), std::pair(31, 17), std::pair(64, 48)}) {
    const Picture picture = pattern(w, h);
    save_png(picture, path.string());
    const Picture back = read_png(path.string());
    CHECK(back.width == w);
    CHECK(back.height == h);
    CHECK(back.pixels == picture.pixels);
  }
  std::filesystem::remove(path);
}

TEST_CASE("a path that cannot be written is named, with the reason") {
  CHECK_THROWS_WITH_AS(save_png(pattern(2, 2), "no/such/folder/a.png"),
                       "no/such/folder/a.png: the file cannot be written: no such folder: "
                       "no/such/folder",
                       Error);
  CHECK_THROWS_WITH_AS(save_png(pattern(2, 2), ""), "expected the name of a file, got nothing",
                       Error);
  CHECK_THROWS_WITH_AS(save_png(pattern(2, 2), "/dev/full"),
                       "/dev/full: expected a file to write, got a special file", Error);
}

TEST_CASE("a picture whose pixels do not fit its size is rejected") {
  Picture picture = pattern(2, 2);
  picture.pixels.pop_back();
  CHECK_THROWS_WITH_AS(save_png(picture, "a.png"),
                       "cannot write 'a.png': a picture of 2 x 2 pixels needs 12 bytes, got 11",
                       Error);
  CHECK_THROWS_WITH_AS(save_png({}, "a.png"),
                       "cannot write 'a.png': a picture of 0 x 0 pixels needs 0 bytes, got 0",
                       Error);
}

TEST_CASE("a full disk is an error, not a truncated file") {
  if (!std::filesystem::exists("/dev/full")) return;
  CHECK_THROWS_AS(save_png(pattern(64, 48), "/dev/full"), Error);
}
