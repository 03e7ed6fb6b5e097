// Textures in pictures of both qualities.
#include <algorithm>

#include "pictures.h"

using namespace clench;
using namespace clench::test;

namespace {

using Rgb = std::array<uint8_t, 3>;
constexpr Rgb image_red{220, 10, 10}, image_green{10, 200, 10}, image_blue{20, 20, 220};

// columns of these colors, each `width` pixels wide
std::shared_ptr<const Image> columns(const std::vector<Rgb>& colors, int width = 32) {
  Image image{static_cast<int>(colors.size()) * width, 64};
  for (int y = 0; y < image.height; ++y)
    for (const Rgb& color : colors)
      for (int x = 0; x < width; ++x)
        image.pixels.insert(image.pixels.end(), color.begin(), color.end());
  return std::make_shared<const Image>(std::move(image));
}

// quads side by side along x, from x = 0 on, each 1 wide and 1 high; they face -y
Mesh quads(int count) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const double x = i, y = 0.02 * i;  // in different planes, so that no vertex is shared
    mesh.vertices.insert(mesh.vertices.end(), {{x, y, 0}, {x + 1, y, 0}, {x + 1, y, 1}, {x, y, 1}});
    mesh.triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
    mesh.triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
  }
  return mesh;
}

// the complete image on a quad, with u repeated `repeats` times
void put(Skin& skin, int texture, float repeats = 1) {
  using V = Eigen::Vector2f;
  const V a(0, 1), b(repeats, 1), c(repeats, 0), d(0, 0);
  skin.triangles.push_back({texture, {a, b, c}});
  skin.triangles.push_back({texture, {a, c, d}});
}

Scene quad_scene(const Skin& skin) {
  Scene scene;
  scene.meshes.push_back(solid(quads(static_cast<int>(skin.triangles.size() / 2)), {1, 1, 1}));
  scene.meshes[0].skin = std::make_shared<const Skin>(skin);
  Eye eye;
  eye.target = {0.5 * static_cast<double>(skin.triangles.size() / 2), 0, 0.5};
  eye.eye = eye.target - Eigen::Vector3d(0, 10, 0);
  eye.ortho_height = 1;
  scene.eye = eye;
  return scene;
}

// `width` pixels for each quad
RenderOptions options(Quality quality, int quads, int width = 64) {
  return {.width = width * quads, .height = width, .samples = 4, .quality = quality, .outline = 0};
}

char strongest(const Color& c) {
  const auto at = std::ranges::max_element(c);
  const int others = c[0] + c[1] + c[2] - *at;  // for gray, twice as much
  return *at > 0.6 * others ? "rgb"[at - c.begin()] : '-';
}

// the strongest color at the centers of columns
std::string letters(const Picture& picture, int count) {
  std::string out;
  for (int i = 0; i < count; ++i)
    out += strongest(pixel(picture, (2 * i + 1) * picture.width / (2 * count), picture.height / 2));
  return out;
}

}  // namespace

TEST_CASE(
    "an image lies on its triangles according to their coordinates, and is wrapped beyond its "
    "edges") {
  REQUIRE_PICTURES();
  const auto image = columns({image_red, image_green});
  for (const Quality quality : {Quality::draft, Quality::paper})
    for (const float opacity : {1.0f, 0.7f})
      for (const auto& [wrap, expected] :
           {std::pair(Wrap::repeat, "rgrg"), {Wrap::mirror, "rggr"}, {Wrap::clamp, "rggg"}}) {
        Skin skin{.textures = {{image, wrap, Wrap::repeat}}};
        put(skin, 0, 2);
        Scene scene = quad_scene(skin);
        scene.meshes[0].opacity = opacity;
        CHECK(letters(render(scene, options(quality, 1)), 4) == expected);
      }
}

TEST_CASE("rows of an image run from the top") {
  REQUIRE_PICTURES();
  Image image{8, 16};
  for (int i = 0; i < 8 * 16; ++i) {
    const Rgb& color = i < 8 * 8 ? image_red : image_blue;
    image.pixels.insert(image.pixels.end(), color.begin(), color.end());
  }
  Skin skin{.textures = {{std::make_shared<const Image>(image)}}};
  put(skin, 0);
  for (const Quality quality : {Quality::draft, Quality::paper}) {
    const Picture picture = render(quad_scene(skin), options(quality, 1));
    CHECK(strongest(pixel(picture, 32, 12)) == 'r');
    CHECK(strongest(pixel(picture, 32, 52)) == 'b');
  }
}

TEST_CASE("triangles of several textures, and of none, keep theirs in any order") {
  REQUIRE_PICTURES();
  Skin skin{.textures = {{columns({image_red})}, {columns({image_blue})}}};
  for (const int texture : {1, -1, 0, -1, 1, 0}) put(skin, texture);
  for (const float opacity : {1.0f, 0.7f}) {
    Scene scene = quad_scene(skin);
    scene.meshes[0].opacity = opacity;
    scene.meshes[0].triangle_colors.assign(12, {0.05f, 0.8f, 0.05f});
    for (const Quality quality : {Quality::draft, Quality::paper})
      CHECK(letters(render(scene, options(quality, 6)), 6) == "bgrgbr");
  }
}

TEST_CASE("an image of one color looks like triangles of that color, also with a tint") {
  REQUIRE_PICTURES();
  for (const Quality quality : {Quality::draft, Quality::paper})
    for (const float tint : {1.0f, 0.5f}) {
      Skin skin{.textures = {{columns({{200, 120, 90}})}}};
      skin.textures[0].tint.setConstant(tint);
      put(skin, 0);
      Scene textured = quad_scene(skin), plain = textured;
      plain.meshes[0].skin.reset();
      plain.meshes[0].color = tint * Eigen::Vector3f(200, 120, 90) / 255;
      const Picture a = render(textured, options(quality, 1)),
                    b = render(plain, options(quality, 1));
      int most = 0;
      for (size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
      CHECK(most <= 4);  // colors use a power of 2.2, images sRGB, which is lighter for dark colors
      // and it is not the white of the mesh
      CHECK(pixel(a, 32, 32)[0] > pixel(a, 32, 32)[2] + 30);
    }
}

TEST_CASE("a fine pattern is uniform from far away") {
  REQUIRE_PICTURES();
  std::vector<Rgb> stripes;
  for (int i = 0; i < 512; ++i) stripes.push_back(i % 2 ? Rgb{255, 255, 255} : Rgb{0, 0, 0});
  Skin skin{.textures = {{columns(stripes, 1)}}};
  put(skin, 0);
  const Picture picture = render(quad_scene(skin), options(Quality::draft, 1, 48));
  int darkest = 765, brightest = 0;
  for (int x = 8; x < 40; ++x) {
    darkest = std::min(darkest, brightness(pixel(picture, x, 24)));
    brightest = std::max(brightest, brightness(pixel(picture, x, 24)));
  }
  CHECK(brightest - darkest <= 12);
  CHECK(darkest > 150);
}

TEST_CASE("a skin that does not fit its mesh is rejected") {
  Skin skin{.textures = {{columns({image_red})}}};
  put(skin, 0);
  const auto refused = [](const Scene& scene, const char* sentence) {
    CHECK_THROWS_WITH_AS(render(scene, {.width = 16, .height = 16}), sentence, Error);
  };
  Scene scene = quad_scene(skin);
  Skin wrong = skin;
  wrong.triangles.pop_back();
  scene.meshes[0].skin = std::make_shared<const Skin>(wrong);
  refused(scene, "picture: mesh 1: expected places in images for each of 2 triangles, got 1");
  wrong = skin;
  wrong.triangles[0].texture = 1;
  scene.meshes[0].skin = std::make_shared<const Skin>(wrong);
  refused(scene, "picture: mesh 1: expected one of 1 textures, got 1");
  wrong = skin;
  wrong.textures[0].image.reset();
  scene.meshes[0].skin = std::make_shared<const Skin>(wrong);
  refused(scene, "picture: mesh 1: expected textures to have images");
}
