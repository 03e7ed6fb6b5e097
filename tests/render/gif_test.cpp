#include "clench/render/figure/gif.h"

#include <doctest/doctest.h>
#include <gif_lib.h>

#include <array>
#include <cstring>
#include <string_view>

#include "clench/base/error.h"

using namespace clench;

namespace {

// 90 x 60, with `columns` x `rows` shades that five bits per channel distinguish
Picture squares(int columns, int rows, int turn) {
  Picture picture{90, 60, {}};
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 90; ++x)
      for (const int value : {x * columns / 90, y * rows / 60, 4 * turn})
        picture.pixels.push_back(static_cast<uint8_t>(8 * value));
  return picture;
}

int read(GifFileType* file, GifByteType* to, int count) {
  auto& rest = *static_cast<std::string_view*>(file->UserData);
  const size_t given = std::min(rest.size(), static_cast<size_t>(count));
  std::memcpy(to, rest.data(), given);
  rest.remove_prefix(given);
  return static_cast<int>(given);
}

}  // namespace

TEST_CASE("an animated GIF, read back, has the pixels of its pictures, and their delays") {
  constexpr std::array delays = {3, 4, 700};
  // 240 colors in all, and 2,700, which are represented by 256
  for (const auto& [columns, rows] : {std::pair{10, 8}, std::pair{30, 30}}) {
    const std::array frames = {squares(columns, rows, 0), squares(columns, rows, 1),
                               squares(columns, rows, 2)};
    const std::string bytes = gif_bytes(frames, delays);
    std::string_view rest = bytes;
    int error = 0;
    GifFileType* file = DGifOpen(&rest, read, &error);
    REQUIRE(file);
    REQUIRE(DGifSlurp(file) == GIF_OK);
    REQUIRE(file->ImageCount == 3);
    for (int i = 0; i < 3; ++i) {
      const SavedImage& image = file->SavedImages[i];
      REQUIRE(image.ImageDesc.Width == 90);
      REQUIRE(image.ImageDesc.Height == 60);
      GraphicsControlBlock control;
      REQUIRE(DGifSavedExtensionToGCB(file, i, &control) == GIF_OK);
      CHECK(control.DelayTime == delays[i]);
      double sum = 0;
      for (size_t p = 0; p < 90 * 60; ++p) {
        const GifColorType& color = file->SColorMap->Colors[image.RasterBits[p]];
        const std::array rgb = {color.Red, color.Green, color.Blue};
        for (size_t c = 0; c < 3; ++c) sum += std::abs(rgb[c] - frames[i].pixels[3 * p + c]);
      }
      // 85 colors per frame, by halving: 8 x 8 or more, squares of 30, whose points are a quarter
      // of that from the center
      CHECK(sum / (3 * 90 * 60) <= (columns == 10 ? 0 : 30 / 4.0));
    }
    CHECK(DGifCloseFile(file, &error) == GIF_OK);
    CHECK(gif_bytes(frames, delays) == bytes);
  }
}

TEST_CASE("invalid pictures of an animated GIF are reported") {
  const std::array frames = {Picture{9, 6, std::vector<uint8_t>(9 * 6 * 3)},
                             Picture{9, 7, std::vector<uint8_t>(9 * 7 * 3)}};
  CHECK_THROWS_WITH_AS(gif_bytes({}, {}),
                       "an animated GIF: expected at least one picture, got none", Error);
  CHECK_THROWS_WITH_AS(
      gif_bytes(frames, std::array{1, 1}),
      "an animated GIF: picture 2: expected 9 x 6 pixels as in the first, got 9 x 7", Error);
  CHECK_THROWS_WITH_AS(gif_bytes(std::span(frames).first(1), {}),
                       "an animated GIF: expected 1 delays, got 0", Error);
}
