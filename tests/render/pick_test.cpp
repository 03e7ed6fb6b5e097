#include "clench/render/view/pick.h"

#include <algorithm>
#include <set>

#include "clench/render/view/frame.h"
#include "pictures.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;

namespace {

constexpr int pick_width = 160, pick_height = 120;

std::optional<Picked> pick_at(const Scene& scene, const Eye& eye, int x, int y) {
  return pick(scene, eye, {x + 0.5, y + 0.5, pick_width, pick_height});
}

Shown body_number(int i) {
  return {.kind = Shown::Kind::body, .body = {static_cast<uint32_t>(i), 1}};
}

// three bodies, one cone and one arrow, distinguished by hue
Scene five_things(Random& random) {
  Scene scene;
  const Eigen::Vector3f hues[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) {
    scene.meshes.push_back(solid(potato(random, 0.5), hues[i], random_pose(random, 0.6)));
    scene.meshes.back().shown = body_number(i);
  }
  scene.cones.push_back({.apex = random_point(random),
                         .axis = random_direction(random),
                         .half_angle = 0.5,
                         .height = 0.8,
                         .color = {1, 1, 0},
                         .shown = {.kind = Shown::Kind::contact, .index = 3}});
  scene.arrows.push_back({.tail = random_point(random),
                          .tip = random_point(random),
                          .radius = 0.1,
                          .color = {0, 1, 1},
                          .shown = {.kind = Shown::Kind::force, .index = 4}});
  return scene;
}

// index in five_things by hue: 0..4, or -1 if it is uncertain
int hue_of(const Color& c) {
  const int top = *std::ranges::max_element(c);
  if (top < 40) return -1;
  bool high[3];
  for (int k = 0; k < 3; ++k) {
    high[k] = 10 * c[k] > 8 * top;
    if (!high[k] && 10 * c[k] > 6 * top) return -1;
  }
  if (high[0] && high[1] && !high[2]) return 3;
  if (!high[0] && high[1] && high[2]) return 4;
  for (int k = 0; k < 3; ++k)
    if (high[k] && !high[(k + 1) % 3] && !high[(k + 2) % 3]) return k;
  return -1;
}

int number_of(const Shown& shown) {
  return shown.kind == Shown::Kind::body ? static_cast<int>(shown.body.index) : shown.index;
}

}  // namespace

TEST_CASE("picking at a pixel returns the object that the picture shows there") {
  REQUIRE_PICTURES();
  Random random(7);
  int agreed = 0;
  std::set<int> met;
  for (int i = 0; i < 8; ++i) {
    Scene scene = five_things(random);
    Eye eye{.eye = 4 * random_direction(random)};
    if (i % 2) eye.ortho_height = 3;
    scene.eye = eye;
    const Picture picture = render(scene, {.width = pick_width,
                                           .height = pick_height,
                                           .quality = Quality::draft,
                                           .backdrop = Backdrop::transparent});
    int differ = 0;
    for (int y = 1; y + 1 < pick_height; ++y)
      for (int x = 1; x + 1 < pick_width; ++x) {
        // not at edges, which are smoothed
        std::set<int> around;
        for (int k = 0; k < 9; ++k) {
          const int px = x + k % 3 - 1, py = y + k / 3 - 1;
          const bool there = picture.alpha[py * pick_width + px] == 255;
          const bool empty = picture.alpha[py * pick_width + px] == 0;
          around.insert(there ? hue_of(pixel(picture, px, py)) : empty ? -2 : -1);
        }
        if (around.size() != 1 || around.contains(-1)) continue;
        const auto picked = pick_at(scene, eye, x, y);
        const int shown = *around.begin(), found = picked ? number_of(picked->shown) : -2;
        differ += shown != found;
        agreed += shown == found && shown >= 0;
        met.insert(found);
      }
    CHECK(differ == 0);
  }
  CHECK(agreed > 10000);
  CHECK(met == std::set{-2, 0, 1, 2, 3, 4});
}

TEST_CASE("a picked point is in its pixel, on the nearest triangle, whose normal faces the eye") {
  Random random(11);
  for (int i = 0; i < 40; ++i) {
    Scene scene;
    for (int k = 0; k < 3; ++k)
      scene.meshes.push_back(solid(soup(random, 30, 0.5), {1, 1, 1}, random_pose(random, 0.5)));
    Eye eye{.eye = 3 * random_direction(random), .target = random_point(random, 0.2)};
    if (i % 2) eye.ortho_height = 2;
    if (i % 3 == 0) eye.aside = 0.1;
    const int x = static_cast<int>(random.uniform(40, 120)),
              y = static_cast<int>(random.uniform(30, 90));
    const auto picked = pick_at(scene, eye, x, y);
    const Eigen::Matrix4d clip =
        view_projection(eye, static_cast<double>(pick_width) / pick_height, 0.01, 100);
    // depth of every triangle that covers the center of the pixel
    double nearest = std::numeric_limits<double>::infinity();
    const Eigen::Vector2d middle((x + 0.5) / pick_width * 2 - 1, 1 - (y + 0.5) / pick_height * 2);
    for (const DrawMesh& mesh : scene.meshes)
      for (const Triangle& t : mesh.shape->mesh().triangles) {
        Eigen::Matrix3d corners;  // x, y, w of each
        Eigen::Vector3d depths;
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector4d c =
              clip * (mesh.X_WM * mesh.shape->mesh().vertices[t[k]]).homogeneous();
          corners.col(k) << c.x(), c.y(), c.w();
          depths[k] = c.z();
        }
        if (std::abs(corners.determinant()) < 1e-12) continue;
        const Eigen::Vector3d parts =
            corners.inverse() * Eigen::Vector3d(middle.x(), middle.y(), 1);
        if (parts.minCoeff() < 0) continue;
        nearest = std::min(nearest, depths.dot(parts));
      }
    REQUIRE(picked.has_value() == std::isfinite(nearest));
    if (!picked) continue;
    const Eigen::Vector4d at = clip * picked->p_W.homogeneous();
    CHECK((at.head<2>() / at.w() - middle).norm() < 1e-9);
    CHECK(at.z() / at.w() == doctest::Approx(nearest).epsilon(1e-9));
    CHECK(picked->n_W.norm() == doctest::Approx(1));
    const Eigen::Vector3d view =
        eye.ortho_height > 0 ? Eigen::Vector3d(view_axes(eye).col(2)) : eye.eye - picked->p_W;
    CHECK(picked->n_W.dot(view) >= 0);
    if (eye.ortho_height == 0)
      CHECK((picked->p_W - eye.eye).norm() == doctest::Approx(picked->distance));
  }
}

TEST_CASE("glass is picked, invisible objects are not, and the floor only from above") {
  Scene scene;
  scene.meshes.push_back(solid(box(1, 1, 1)));
  scene.meshes.back().opacity = 0.3f;
  scene.meshes.back().shown = body_number(5);
  scene.ground = -0.5;
  const Eye above{.eye = {0, -3, 2}};
  CHECK(pick_at(scene, above, 80, 60)->shown == body_number(5));
  scene.meshes.back().opacity = 0;
  const auto floor = pick_at(scene, above, 80, 60);
  REQUIRE(floor);
  CHECK(floor->shown == Shown{.kind = Shown::Kind::floor});
  CHECK(floor->p_W.z() == doctest::Approx(-0.5));
  CHECK(floor->n_W == Eigen::Vector3d::UnitZ());
  CHECK_FALSE(pick_at(scene, {.eye = {0, -3, -2}}, 80, 60));
  CHECK_FALSE(pick({}, above, {10, 10, 20, 20}));
  CHECK_THROWS_WITH_AS(pick(scene, above, {0, 0, 0, 20}),
                       "picture: its size must be > 0, got 0 x 20", Error);
}
