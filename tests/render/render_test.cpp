#include "clench/render/render.h"

#include <limits>
#include <thread>

#include "clench/render/view/frame.h"
#include "pictures.h"

using namespace clench;
using namespace clench::test;

namespace {

const RenderOptions small{.width = 96, .height = 72, .samples = 4};

Scene red_box() {
  Scene scene;
  scene.meshes.push_back(solid(box(1, 1, 1)));
  return scene;
}

// objects of all kinds: solid, transparent, colored by triangle, a cone and a needle, a floor
Scene still_life() {
  Scene scene = red_box();
  scene.meshes.push_back(solid(ball(0.5), {0.2f, 0.5f, 0.9f}, Pose::translation({1.2, 0.3, 0})));
  scene.meshes.back().opacity = 0.4f;
  scene.meshes.push_back(solid(box(0.4, 0.4, 0.4), {1, 1, 1}, Pose::translation({0, -1, -0.3})));
  scene.meshes.back().triangle_colors.assign(12, {0.1f, 0.9f, 0.2f});
  scene.cones.resize(2);
  scene.cones[0].apex = scene.cones[1].apex = {1.2, 0.3, 0.5};
  scene.cones[0].axis = -Eigen::Vector3d::UnitZ();
  scene.cones[0].half_angle = 0.5;
  scene.cones[0].height = scene.cones[1].height = 0.3;
  scene.ground = -0.5;
  return scene;
}

Eye looking_along_y(double distance) {
  Eye eye;
  eye.eye = {0, -distance, 0};
  eye.field_of_view = 0.8;
  return eye;
}

int greatest_difference(const Picture& a, const Picture& b) {
  REQUIRE(a.pixels.size() == b.pixels.size());
  int most = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
  return most;
}

}  // namespace

TEST_CASE("the same scene gives identical bytes") {
  REQUIRE_PICTURES();
  const Scene scene = still_life();
  CHECK(render(scene, small).pixels == render(scene, small).pixels);
}

TEST_CASE("threads draw at the same time, each the same as alone") {
  REQUIRE_PICTURES();
  const Scene scene = still_life();
  const Picture alone = render(scene, small);
  std::array<Picture, 3> pictures;
  std::vector<std::thread> threads;
  for (Picture& picture : pictures) threads.emplace_back([&] { picture = render(scene, small); });
  for (std::thread& thread : threads) thread.join();
  for (const Picture& picture : pictures) CHECK(picture.pixels == alone.pixels);
}

TEST_CASE("a red box is red at its center, and the corners are background") {
  REQUIRE_PICTURES();
  const Picture picture = render(red_box(), small), nothing = render({}, small);
  CHECK(is_red(pixel(picture, 48, 36)));
  for (const int x : {0, 95})
    for (const int y : {0, 71}) CHECK(pixel(picture, x, y) == pixel(nothing, x, y));
}

TEST_CASE("a picture has the requested size, in one tile or several") {
  REQUIRE_PICTURES();
  for (const auto& [w, h] : {std::pair(16, 16), std::pair(200, 33), std::pair(1600, 40)}) {
    const Picture picture = render(red_box(), {.width = w, .height = h, .samples = 1});
    CHECK(picture.width == w);
    CHECK(picture.height == h);
    CHECK(picture.pixels.size() == 3u * w * h);
  }
}

TEST_CASE("no seam is visible between tiles") {
  REQUIRE_PICTURES();
  // tiles end at 1536: a wall across that column has the same color on both sides
  Scene scene;
  scene.meshes.push_back(solid(box(40, 1, 40)));
  scene.eye = looking_along_y(10);
  const Picture picture = render(scene, {.width = 1568, .height = 24, .samples = 1});
  for (int y = 0; y < 24; ++y) {
    const Color left = pixel(picture, 1535, y), right = pixel(picture, 1536, y);
    // a lit wall changes slowly: neighbors differ by less than 2 of 255
    for (int k = 0; k < 3; ++k) CHECK(std::abs(left[k] - right[k]) < 2);
  }
}

TEST_CASE("a given camera is used: a known point is at its projection") {
  REQUIRE_PICTURES();
  Scene scene;
  const Eigen::Vector3d p_W(0.31, 0.2, -0.17);
  scene.meshes.push_back(solid(ball(0.03), {0.9f, 0, 0}, Pose::translation(p_W)));
  scene.meshes.push_back(solid(box(0.02, 0.02, 0.02), {0, 0, 0.9f}, Pose::translation({-1, 0, 0})));
  Eye eye;
  eye.eye = {0.5, -2, 0.8};
  eye.target = {0.1, 0, 0};
  eye.up = {0.2, 0.1, 1};
  eye.field_of_view = 0.5;
  scene.eye = eye;
  const Eigen::Vector4d clip = view_projection(eye, 96.0 / 72, 0.1, 10) * p_W.homogeneous();
  const double x = (0.5 + 0.5 * clip.x() / clip.w()) * 96,
               y = (0.5 - 0.5 * clip.y() / clip.w()) * 72;
  const Picture picture = render(scene, small);
  // a ball of 0.03 m at 2.3 m has a radius of about two pixels: it covers its center, not pixels
  // five away
  CHECK(is_red(pixel(picture, static_cast<int>(x), static_cast<int>(y))));
  CHECK(!is_red(pixel(picture, static_cast<int>(x) + 5, static_cast<int>(y))));
  CHECK(!is_red(pixel(picture, static_cast<int>(x), static_cast<int>(y) - 5)));
}

TEST_CASE("z is up and x is to the right for a camera that looks along y") {
  REQUIRE_PICTURES();
  Scene scene;
  scene.meshes.push_back(solid(box(0.3, 0.3, 0.3), {0.9f, 0, 0}, Pose::translation({0.6, 0, 0.4})));
  scene.eye = looking_along_y(4);
  const Picture picture = render(scene, small);
  // 72 pixels cover 2 * 4 * tan(0.4) = 3.38 m: the box's center is 12.8 right and 8.5 up of the
  // center
  CHECK(is_red(pixel(picture, 48 + 12, 36 - 8)));
  CHECK(!is_red(pixel(picture, 48 - 12, 36 - 8)));
  CHECK(!is_red(pixel(picture, 48 + 12, 36 + 8)));
}

TEST_CASE("near objects hide distant ones, in either order") {
  REQUIRE_PICTURES();
  const DrawMesh near = solid(box(1, 0.1, 1), {0.9f, 0, 0}, Pose::translation({0, -1, 0}));
  const DrawMesh far = solid(box(1, 0.1, 1), {0, 0, 0.9f}, Pose::translation({0, 1, 0}));
  Scene one, other;
  one.meshes = {near, far};
  other.meshes = {far, near};
  one.eye = other.eye = looking_along_y(5);
  CHECK(is_red(pixel(render(one, small), 48, 36)));
  CHECK(is_red(pixel(render(other, small), 48, 36)));
}

TEST_CASE("objects behind a transparent box are visible") {
  REQUIRE_PICTURES();
  Scene scene;
  scene.meshes.push_back(solid(ball(0.3), {0.95f, 0, 0}, Pose::translation({0, 1, 0})));
  scene.meshes.push_back(solid(box(1, 0.2, 1), {0, 0, 0.9f}, Pose::translation({0, -0.5, 0})));
  scene.eye = looking_along_y(5);
  const Color hidden = pixel(render(scene, small), 48, 36);
  scene.meshes[1].opacity = 0.3f;
  const Color shown = pixel(render(scene, small), 48, 36);
  scene.meshes[1].opacity = 0;
  const Color alone = pixel(render(scene, small), 48, 36);
  CHECK(hidden[0] < hidden[2]);
  CHECK(shown[0] > hidden[0] + 50);
  CHECK(shown[2] > alone[2] + 10);
  CHECK(is_red(alone));
}

TEST_CASE("a cone inside a transparent body is visible, and inside a solid one it is not") {
  REQUIRE_PICTURES();
  Scene scene;
  scene.meshes.push_back(solid(ball(0.5), {0, 0, 0.9f}));
  scene.meshes[0].opacity = 0.3f;
  scene.cones.resize(1);
  scene.cones[0] = {.apex = {0, 0, 0.2},
                    .axis = {0, 0, -1},
                    .half_angle = 0.7,
                    .height = 0.4,
                    .color = {1, 0, 0}};
  scene.eye = looking_along_y(3);
  const Color shown = pixel(render(scene, small), 48, 36);
  scene.meshes[0].opacity = 1;
  const Color hidden = pixel(render(scene, small), 48, 36);
  CHECK(shown[0] > shown[2]);
  CHECK(hidden[0] < hidden[2]);
}

TEST_CASE("a box casts a shadow on the floor, and a thinner one a thinner shadow") {
  REQUIRE_PICTURES();
  Scene scene;
  scene.meshes.push_back(solid(box(1, 1, 1), {0.8f, 0.8f, 0.8f}));
  scene.ground = -0.5;
  Eye eye;
  eye.eye = {0, -6, 3};
  scene.eye = eye;
  // the lamp is at the upper left: the floor right of the box is in its shadow
  const auto at = [&](const Picture& picture) {
    const Eigen::Vector4d clip =
        view_projection(eye, 96.0 / 72, 0.1, 100) * Eigen::Vector4d(0.75, 0, -0.5, 1);
    return brightness(pixel(picture, static_cast<int>((0.5 + 0.5 * clip.x() / clip.w()) * 96),
                            static_cast<int>((0.5 - 0.5 * clip.y() / clip.w()) * 72)));
  };
  const int shadow = at(render(scene, small));
  scene.meshes[0].opacity = 0.4f;
  const int thin = at(render(scene, small));
  const int none = at(render({.meshes = {}, .cones = {}, .ground = -0.5, .eye = eye}, small));
  CHECK(shadow + 60 < none);
  CHECK(shadow + 20 < thin);
  CHECK(thin + 20 < none);
}

TEST_CASE("a mesh with reversed triangles looks the same") {
  REQUIRE_PICTURES();
  Mesh turned = ball(0.5);
  // half of them: neighbors disagree, as in many files
  for (size_t i = 0; i < turned.triangles.size(); i += 2)
    std::swap(turned.triangles[i][0], turned.triangles[i][1]);
  Scene one, other;
  one.meshes.push_back(solid(ball(0.5)));
  other.meshes.push_back(solid(turned));
  one.ground = other.ground = -0.5;
  // the diagonals of split quads depend on the order of corners: light differs slightly where it is
  // interpolated
  CHECK(greatest_difference(render(one, small), render(other, small)) <= 8);
}

TEST_CASE("scenes of a millimeter and of a kilometer give the same picture") {
  REQUIRE_PICTURES();
  // scaling by a power of two is exact, so the pictures are byte-identical
  const auto scaled = [](double factor) {
    Scene scene;
    Mesh mesh = box(1, 0.7, 0.5);
    for (auto& p : mesh.vertices) p *= factor;
    scene.meshes.push_back(solid(mesh));
    scene.ground = -0.25 * factor;
    return render(scene, small);
  };
  const Picture meter = scaled(1);
  CHECK(scaled(1.0 / 1024).pixels == meter.pixels);
  CHECK(scaled(1024).pixels == meter.pixels);
  CHECK(scaled(std::ldexp(1, 29)).pixels == meter.pixels);
}

TEST_CASE("views from very near and very far are correct") {
  REQUIRE_PICTURES();
  Scene scene = red_box();
  // a millimeter off the face of a box of a meter
  scene.eye = looking_along_y(0.501);
  CHECK(is_red(pixel(render(scene, small), 48, 36)));
  // from ten kilometers, with a narrow field of view
  scene.eye = looking_along_y(1e4);
  scene.eye->field_of_view = 0.001;
  CHECK(is_red(pixel(render(scene, small), 48, 36)));
  // from inside: the sides are seen from behind, and nothing fails
  scene.eye = looking_along_y(0.1);
  CHECK(render(scene, small).pixels.size() == 3u * 96 * 72);
}

TEST_CASE("a background mesh receives the shadow and does not affect the frame") {
  REQUIRE_PICTURES();
  Scene scene = red_box();
  scene.meshes.push_back(
      solid(box(500, 500, 0.1), {0.8f, 0.8f, 0.8f}, Pose::translation({0, 0, -0.55})));
  scene.meshes.back().background = true;
  CHECK(is_red(pixel(render(scene, small), 48, 36)));
  const Eye eye = frame_all(scene, 1);
  CHECK((eye.eye - eye.target).norm() < 10);
}

TEST_CASE("an empty scene, and only degenerate triangles, are valid") {
  REQUIRE_PICTURES();
  const Picture nothing = render({}, small);
  CHECK(nothing.pixels.size() == 3u * 96 * 72);
  Mesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0, 0, 0}};
  flat.triangles = {{0, 1, 2}, {0, 3, 1}, {2, 2, 2}};
  Scene scene;
  scene.meshes.push_back(solid(flat));
  CHECK(render(scene, small).pixels == nothing.pixels);
  scene.meshes[0].shape = nullptr;
  CHECK(render(scene, small).pixels == nothing.pixels);
  // one point
  flat.vertices.assign(3, {7, 8, 9});
  flat.triangles = {{0, 1, 2}};
  scene.meshes = {solid(flat)};
  CHECK(render(scene, small).pixels == nothing.pixels);
}

TEST_CASE("numbers out of range are rejected by name") {
  REQUIRE_PICTURES();
  CHECK_THROWS_WITH_AS(render({}, {.width = 15}),
                       "picture: width must be between 16 and 8192 pixels, got 15", Error);
  CHECK_THROWS_WITH_AS(render({}, {.height = 8193}),
                       "picture: height must be between 16 and 8192 pixels, got 8193", Error);
  CHECK_THROWS_WITH_AS(render({}, {.samples = 0}),
                       "picture: samples must be between 1 and 256, got 0", Error);
  CHECK_THROWS_WITH_AS(render({}, {.width = 8192, .height = 8192, .samples = 256}),
                       "picture: expected at most 1073741824 pixels times samples, got 17179869184",
                       Error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene = red_box();
  scene.eye = Eye{};
  scene.eye->eye = {nan, 0, 0};
  CHECK_THROWS_WITH_AS(render(scene), "picture: eye, target and up must be finite numbers", Error);
  scene.eye->eye = scene.eye->target;
  CHECK_THROWS_WITH_AS(render(scene),
                       "picture: eye and target must be two points, got (0, 0, 0) for the eye",
                       Error);
  scene.eye = Eye{};
  scene.eye->field_of_view = 3.2;
  CHECK_THROWS_WITH_AS(render(scene),
                       "picture: field of view must be between 0.001 and 3 [rad], got 3.2", Error);
}

TEST_CASE("a glass box on the floor and one on a table show the same bottom from any side") {
  REQUIRE_PICTURES();
  // the table's top is as high as the floor of the first scene
  for (const bool table : {false, true})
    for (const Quality quality : {Quality::draft, Quality::paper})
      for (int view = 0; view < 6; ++view) {
        Scene scene;
        scene.meshes.push_back(
            solid(box(0.1, 0.1, 0.1), {0, 0, 1}, Pose::translation({0, 0, 0.05})));
        scene.meshes[0].opacity = 0.3f;
        if (table)
          scene.meshes.push_back(
              solid(box(0.4, 0.4, 0.02), {1, 1, 1}, Pose::translation({0, 0, -0.01})));
        else
          scene.ground = 0;
        Eye eye;
        eye.eye = {0.013 * view - 0.03, -0.3 + 0.004 * view, 0.31};
        eye.target = {0, 0, 0};
        scene.eye = eye;
        const Picture picture =
            render(scene, {.width = 96, .height = 96, .samples = 1, .quality = quality});
        // within the bottom neighbors differ by less than one layer of glass
        int most = 0;
        for (int x = 42; x < 54; ++x)
          for (int y = 46; y < 52; ++y) {
            const Color here = pixel(picture, x, y), next = pixel(picture, x + 1, y);
            for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(here[k] - next[k]));
          }
        CAPTURE(view);
        CHECK(most < 12);
      }
}

TEST_CASE("a picture stores its camera, and drawing with that is byte-identical") {
  REQUIRE_PICTURES();
  Scene scene;
  scene.meshes.push_back(solid(box(0.1, 0.2, 0.3)));
  for (const Quality quality : {Quality::draft, Quality::paper}) {
    const RenderOptions options{.width = 64, .height = 48, .samples = 2, .quality = quality};
    const Picture chosen = render(scene, options);
    REQUIRE(chosen.eye);
    Scene again = scene;
    again.eye = chosen.eye;
    CHECK(render(again, options) == chosen);
    again.eye->eye *= 1.1;
    CHECK(render(again, options) != chosen);
  }
}

TEST_CASE("a draft that is drawn larger and reduced has the requested size, and smoother edges") {
  REQUIRE_PICTURES();
  const auto drawn = [](int scale) {
    return render(still_life(),
                  {.width = 96, .height = 72, .draft_scale = scale, .quality = Quality::draft});
  };
  const auto difference = [](const Picture& a, const Picture& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
    return sum;
  };
  const Picture one = drawn(1), two = drawn(2), four = drawn(4);
  CHECK(two.width == 96);
  CHECK(two.height == 72);
  CHECK(difference(two, four) < 0.7 * difference(one, four));
  CHECK_THROWS_WITH_AS(render({}, {.draft_scale = 5, .quality = Quality::draft}),
                       "picture: scale of a draft must be between 1 and 4, got 5", Error);
  CHECK_THROWS_WITH_AS(
      render({}, {.width = 8192, .height = 8192, .draft_scale = 2, .quality = Quality::draft}),
      "picture: expected at most 134217728 pixels times samples of a draft, got 268435456", Error);
}
