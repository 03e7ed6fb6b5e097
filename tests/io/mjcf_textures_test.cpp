// Textures of MJCF materials on geoms.
#include <fmt/format.h>

#include <array>

#include "clench/base/error.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using namespace clench::test;

namespace {

// 2 x 1 pixels: red, blue
const std::string tiny_png(
    "\211\120\116\107\015\012\032\012\000\000\000\015\111\110\104\122\000\000\000"
    "\002\000\000\000\001\010\002\000\000\000\173\100\350\335\000\000\000\015\111"
    "\104\101\124\170\234\143\370\317\000\004\377\001\007\000\001\377\342\043\236"
    "\131\000\000\000\000\111\105\116\104\256\102\140\202",
    70);

struct Textured {
  explicit Textured(const std::string& assets, const std::string& geom,
                    const std::string& mesh = "")
      : told(write(assets, geom, mesh)) {}
  std::string write(const std::string& assets, const std::string& geom, const std::string& mesh) {
    folder.write("t.png", tiny_png);
    if (!mesh.empty()) folder.write("m.obj", mesh);
    return folder.write("m.xml", "<mujoco model='m'><asset>" + assets +
                                     "</asset><worldbody><body name='base'>" + geom +
                                     "</body></worldbody></mujoco>");
  }
  const Appearance& looks() const { return told.body("base").appearance; }
  const Skin& skin() const {
    REQUIRE(looks().skin);
    return *looks().skin;
  }
  const Mesh& mesh() const { return told.body("base").shape->mesh(); }

  TemporaryFolder folder;
  ToldRobot told;
};

const std::string checker =
    "<texture name='t' type='2d' builtin='checker' rgb1='1 0 0' rgb2='0 0 1' width='4' height='4' "
    "mark='edge' markrgb='0 1 0'/>";
const std::string box_geom = "<geom type='box' size='.2 .1 .05' material='m'/>";

}  // namespace

TEST_CASE("a flat image repeats over the geom, or per length, along x and y") {
  for (const bool uniform : {false, true}) {
    const Textured made(
        checker + fmt::format("<material name='m' texture='t' texrepeat='3 2' texuniform='{}'/>",
                              uniform),
        box_geom);
    CHECK(made.told.warnings.empty());
    REQUIRE(made.skin().textures.size() == 1);
    CHECK(made.skin().textures[0].wrap_u == Wrap::repeat);
    for (size_t i = 0; i < made.mesh().triangles.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = made.mesh().vertices[made.mesh().triangles[i][k]];
        const double x = uniform ? p.x() : p.x() / 0.2, y = uniform ? p.y() : p.y() / 0.1;
        const Eigen::Vector2d expected(1.5 * x - 0.5, -y - 0.5);
        CHECK((made.skin().triangles[i].uv[k].cast<double>() - expected).norm() < 1e-6);
      }
  }
}

TEST_CASE("built-in patterns are those of MuJoCo") {
  const Textured made(checker + "<material name='m' texture='t'/>", box_geom);
  const Image& image = *made.skin().textures[0].image;
  REQUIRE(image.pixels.size() == 48);
  const auto at = [&](int x, int y) {
    const uint8_t* p = &image.pixels[static_cast<size_t>(3 * (4 * y + x))];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  CHECK(at(0, 0) == std::array{0, 255, 0});
  CHECK(at(3, 2) == std::array{0, 255, 0});
  CHECK(at(1, 1) == std::array{255, 0, 0});
  CHECK(at(2, 1) == std::array{0, 0, 255});
  CHECK(at(2, 2) == std::array{255, 0, 0});
  // a gradient begins with the first color in the middle, and ends with the second
  const Textured fade(
      "<texture name='t' type='2d' builtin='gradient' rgb1='1 0 0' rgb2='0 0 1' width='41' "
      "height='41'/><material name='m' texture='t'/>",
      box_geom);
  const auto& pixels = fade.skin().textures[0].image->pixels;
  const size_t middle = 3 * (41 * 20 + 20);
  CHECK(pixels[middle] == 255);
  CHECK(pixels[0] == 0);
  CHECK(pixels[2] == 255);
}

TEST_CASE("each side of a box has the image of a cube once, whatever its lengths") {
  const Textured made("<texture name='t' file='t.png'/><material name='m' texture='t'/>", box_geom);
  CHECK(made.told.warnings.empty());
  CHECK(made.skin().textures.size() == 1);  // all sides share it
  for (const TexturedTriangle& triangle : made.skin().triangles) {
    Eigen::Vector2f low(9, 9), high(-9, -9);
    for (const auto& uv : triangle.uv) low = low.cwiseMin(uv), high = high.cwiseMax(uv);
    CHECK(low.norm() < 1e-6f);
    CHECK((high - Eigen::Vector2f(1, 1)).norm() < 1e-6f);
  }
}

TEST_CASE("an image on a mesh lies where the coordinates of its file say, tinted by the color") {
  const Textured made(
      "<texture name='t' type='2d' file='t.png'/><mesh name='g' file='m.obj'/>"
      "<material name='m' texture='t' rgba='1 0.5 0.25 1'/>",
      "<geom type='mesh' mesh='g' material='m'/>",
      "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nvt .1 .2\nvt .9 .2\nvt .5 .8\nvt .25 .5\n"
      "f 1/1 3/3 2/2\nf 1/1 2/2 4/4\nf 1/1 4/4 3/3\nf 2/2 3/3 4/4\n");
  const Skin& skin = made.skin();
  CHECK(skin.textures[0].tint == Eigen::Vector3f(1, 0.5f, 0.25f));
  const Eigen::Vector2f expected[] = {{.1f, .8f}, {.9f, .8f}, {.5f, .2f}, {.25f, .5f}};
  for (size_t i = 0; i < skin.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      CHECK((skin.triangles[i].uv[k] - expected[made.mesh().triangles[i][k]]).norm() < 1e-6f);
  // the color that represents the image is its mean: half red, half blue
  CHECK((made.looks().color - Eigen::Vector3f(0.5f, 0, 0.125f)).norm() < 0.03f);
}

TEST_CASE("textures that are not drawn are named, and leave the color") {
  const auto warned = [](const std::string& texture, const std::string& sentence) {
    const Textured made(texture + "<material name='m' texture='t' rgba='0 1 0 1'/>", box_geom);
    CHECK_FALSE(made.looks().skin);
    CHECK(made.looks().color == Eigen::Vector3f(0, 1, 0));
    REQUIRE(made.told.warnings.size() == 1);
    CHECK(made.told.warned(sentence));
  };
  warned("<texture name='t' file='none.png'/>", "none.png");
  warned("<texture name='t' fileright='a.png' fileleft='b.png'/>",
         "texture 't': images of several");
  warned("<texture name='t' file='t.png' gridsize='3 4'/>", "texture 't': images cut into a grid");
  warned("<texture name='t' type='skybox' file='t.png'/>", "<texture>");
  warned("", "no texture 't'");
}
