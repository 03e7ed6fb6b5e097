#include "clench/spec/skin.h"

#include <doctest/doctest.h>

using namespace clench;

namespace {

std::shared_ptr<const Image> image_of(int width, int height, auto color) {
  Image image{width, height};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixels.push_back(static_cast<uint8_t>(color(x, y, c)));
  return std::make_shared<const Image>(std::move(image));
}

SkinPtr one_triangle(std::shared_ptr<const Image> image) {
  Skin skin{.textures = {{std::move(image)}}};
  skin.triangles.push_back({0, {Eigen::Vector2f(0, 0), {1, 0}, {0, 1}}});
  return std::make_shared<const Skin>(skin);
}

}  // namespace

TEST_CASE("a reduced image keeps its mean color, and small images are unchanged") {
  const auto image =
      image_of(64, 32, [](int x, int y, int c) { return (37 * x + 11 * y * c) % 256; });
  CHECK(image_within(image, 64) == image);
  const auto small = image_within(image, 20);
  CHECK(small->width == 16);
  CHECK(small->height == 8);
  const auto mean = [](const Image& of, int c) {
    double sum = 0;
    for (size_t i = static_cast<size_t>(c); i < of.pixels.size(); i += 3) sum += of.pixels[i];
    return 3 * sum / static_cast<double>(of.pixels.size());
  };
  for (int c = 0; c < 3; ++c) CHECK(std::abs(mean(*small, c) - mean(*image, c)) < 1);
  // odd sides, and sides of one pixel
  const auto plain = image_of(7, 1, [](int, int, int c) { return 10 * c + 5; });
  const auto dot = image_within(plain, 1);
  CHECK(dot->pixels == std::vector<uint8_t>{5, 15, 25});
}

TEST_CASE("skins are compared by their contents") {
  const auto red = image_of(2, 2, [](int, int, int c) { return c == 0 ? 200 : 0; });
  const SkinPtr a = one_triangle(red), b = one_triangle(std::make_shared<const Image>(*red));
  CHECK(same_skin(a, b));
  CHECK(same_skin(nullptr, nullptr));
  CHECK_FALSE(same_skin(a, nullptr));
  Skin other = *a;
  other.textures[0].wrap_v = Wrap::clamp;
  CHECK_FALSE(same_skin(a, std::make_shared<const Skin>(other)));
  other = *a;
  other.triangles[0].uv[2].x() = 0.5f;
  CHECK_FALSE(same_skin(a, std::make_shared<const Skin>(other)));
  CHECK(same_skin(turned_over(turned_over(a)), a));
  CHECK_FALSE(same_skin(turned_over(a), a));
}

TEST_CASE("concatenated parts keep their images, and share equal textures") {
  const auto red = image_of(1, 1, [](int, int, int) { return 9; }),
             blue = image_of(1, 1, [](int, int, int) { return 8; });
  Skin all;
  append_skin(all, nullptr, 2);
  append_skin(all, one_triangle(red), 1);
  append_skin(all, one_triangle(blue), 1);
  append_skin(all, one_triangle(red), 1);
  REQUIRE(all.triangles.size() == 5);
  CHECK(all.textures.size() == 2);
  CHECK(all.triangles[1].texture == -1);
  CHECK(all.textures[static_cast<size_t>(all.triangles[3].texture)].image == blue);
  CHECK(all.textures[static_cast<size_t>(all.triangles[4].texture)].image == red);
}
