#include "clench/render/renderer.h"

#include <thread>

#include "clench/render/view/frame.h"
#include "letters.h"
#include "pictures.h"

using namespace clench;
using namespace clench::test;

namespace {

RenderOptions of(Quality quality, Backdrop backdrop = Backdrop::studio, double outline = 0) {
  return {.width = 160,
          .height = 120,
          .samples = 3,
          .quality = quality,
          .backdrop = backdrop,
          .outline = outline};
}

// solid, transparent, a cone, a floor
Scene some_things(double shift = 0) {
  Scene scene;
  scene.meshes.push_back(
      solid(box(1, 1, 1), {0.85f, 0.05f, 0.05f}, Pose::translation({shift, 0, 0})));
  scene.meshes.push_back(solid(ball(0.5), {0.2f, 0.5f, 0.9f}, Pose::translation({1.2, 0.3, 0})));
  scene.meshes.back().opacity = 0.4f;
  scene.cones.push_back({.apex = {1.2, 0.3, 0.5},
                         .axis = -Eigen::Vector3d::UnitZ(),
                         .half_angle = 0.5,
                         .height = 0.3});
  scene.ground = -0.5;
  return scene;
}

const Quality qualities[] = {Quality::paper, Quality::draft};

class Stopping : public Watcher {
 public:
  explicit Stopping(int after) : after_(after) {}
  void show(double, std::string_view) override {
    if (after_-- <= 0) stop();
  }

 private:
  int after_;
};

}  // namespace

TEST_CASE("a new renderer and one that has drawn other scenes give the same picture") {
  REQUIRE_PICTURES();
  for (const Quality quality : qualities)
    for (const Backdrop backdrop : {Backdrop::studio, Backdrop::white, Backdrop::transparent})
      for (const double outline : {0.0, 1.5}) {
        const RenderOptions options = of(quality, backdrop, outline);
        const Picture expected = Renderer().draw(some_things(), options, letters());
        Renderer used;
        used.draw(some_things(0.3), of(Quality::paper), letters());
        used.draw(some_things(0.1), of(Quality::draft, Backdrop::white, 2), letters());
        CHECK(used.draw(some_things(), options, letters()) == expected);
        Scene turned = some_things();
        turned.eye = Eye{.eye = {3, 2, 1}};
        used.draw(turned, options, letters());
        CHECK(used.draw(some_things(), options, letters()) == expected);
        CHECK(used.draw(some_things(), options, letters()) == expected);
      }
}

TEST_CASE("a renderer that was stopped half way draws the same as a new one") {
  REQUIRE_PICTURES();
  for (const Quality quality : qualities) {
    const Picture expected = Renderer().draw(some_things(), of(quality), letters());
    Renderer renderer;
    int stopped = 0;
    for (int after = 0; after < 30; ++after) {
      RenderOptions options = of(quality);
      options.progress = Progress(std::make_shared<Stopping>(after));
      try {
        renderer.draw(some_things(0.01 * after), options, letters());
      } catch (const Stopped&) {
        ++stopped;
      }
    }
    CHECK(stopped >= 2);
    CHECK(renderer.draw(some_things(), of(quality), letters()) == expected);
  }
}

TEST_CASE("a renderer may draw in any thread, one at a time") {
  REQUIRE_PICTURES();
  Renderer renderer;
  const Picture here = renderer.draw(some_things(), of(Quality::draft), letters());
  Picture there;
  std::thread([&] { there = renderer.draw(some_things(), of(Quality::draft), letters()); }).join();
  CHECK(here == there);
}

TEST_CASE(
    "the cache of a renderer does not grow with the pictures of one scene, and can be cleared") {
  REQUIRE_PICTURES();
  Renderer renderer;
  CHECK(renderer.bytes() == 0);
  const Scene scene = some_things();
  for (const Quality quality : qualities) renderer.draw(scene, of(quality), letters());
  const size_t once = renderer.bytes();
  CHECK(once > 0);
  for (int i = 0; i < 5; ++i)
    for (const Quality quality : qualities) renderer.draw(scene, of(quality), letters());
  CHECK(renderer.bytes() == once);
  renderer.clear();
  CHECK(renderer.bytes() == 0);
}

TEST_CASE("a transparent background contains only bodies and their shadow, and white is white") {
  REQUIRE_PICTURES();
  for (const Quality quality : qualities) {
    const Picture clear = render(some_things(), of(quality, Backdrop::transparent));
    REQUIRE(clear.alpha.size() == 160u * 120u);
    CHECK(clear.alpha[0] == 0);
    CHECK(*std::ranges::max_element(clear.alpha) == 255);
    const auto part = std::ranges::count_if(clear.alpha, [](int a) { return a > 20 && a < 200; });
    CHECK(part > 300);  // glass and shadow
    const Picture white = render(some_things(), of(quality, Backdrop::white));
    CHECK(white.alpha.empty());
    CHECK(pixel(white, 0, 0) == Color{255, 255, 255});
    CHECK(on_white(clear) == white);
    CHECK(render(some_things(), of(quality)).alpha.empty());
  }
}

TEST_CASE("in an orthographic view the size of a body does not depend on its distance") {
  REQUIRE_PICTURES();
  for (const Quality quality : qualities) {
    Scene scene;
    scene.meshes.push_back(
        solid(box(0.4, 0.4, 0.4), {0.9f, 0, 0}, Pose::translation({-0.5, 0, 0})));
    scene.meshes.push_back(solid(box(0.4, 0.4, 0.4), {0.9f, 0, 0}, Pose::translation({0.5, 3, 0})));
    scene.eye = Eye{.eye = {0, -4, 0}, .ortho_height = 1.2};
    const Picture picture = render(scene, of(quality, Backdrop::white));
    int left = 0, right = 0;
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x)
        if (is_red(pixel(picture, x, y))) ++(x < 80 ? left : right);
    CHECK(left == doctest::Approx(40 * 40).epsilon(0.06));
    CHECK(right == doctest::Approx(left).epsilon(0.03));
  }
}

TEST_CASE("outlines surround bodies, with the given width, and no line is within a smooth face") {
  REQUIRE_PICTURES();
  for (const Quality quality : qualities) {
    Scene scene;
    scene.meshes.push_back(solid(box(1, 1, 1), {1, 1, 1}));
    scene.eye = Eye{.eye = {0, -4, 0}, .ortho_height = 2};
    const auto dark = [&](double outline) {
      const Picture p = render(scene, of(quality, Backdrop::white, outline));
      int count = 0;
      for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) count += brightness(pixel(p, x, y)) < 200;
      CHECK(brightness(pixel(p, 80, 60)) > 300);
      return count;
    };
    CHECK(dark(0) == 0);
    const int thin = dark(2), thick = dark(6);
    // the face is 60 pixels wide
    CHECK(thin > 150);
    CHECK(thick > 2 * thin);
    CHECK(thick < 6 * 4 * 70);
  }
}

TEST_CASE("a view from within a body shows its inside") {
  REQUIRE_PICTURES();
  for (const Quality quality : qualities) {
    Scene scene;
    scene.meshes.push_back(solid(box(1, 1, 1)));
    scene.eye = Eye{.eye = {0, 0, 0}, .target = {1, 0, 0}};
    Scene nothing;
    nothing.eye = scene.eye;
    CHECK(pixel(render(scene, of(quality)), 80, 60) != pixel(render(nothing, of(quality)), 80, 60));
  }
}

TEST_CASE("numbers of a picture out of range are rejected by name") {
  const auto fails = [](RenderOptions options, const char* message) {
    CHECK_THROWS_WITH_AS(check(options), message, Error);
  };
  fails({.outline = 33}, "picture: outline must be between 0 and 32 pixels, got 33");
  fails({.outline = -1}, "picture: outline must be between 0 and 32 pixels, got -1");
  fails({.letters = 201}, "picture: letters must be between 0 and 200 pixels, got 201");
  Eye eye;
  eye.ortho_height = -1;
  CHECK_THROWS_WITH_AS(view_axes(eye),
                       "picture: the height of an orthographic view must be >= 0 [m], got -1",
                       Error);
}
