#include "scene/wrench_scene.h"

#include <doctest/doctest.h>

#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

TEST_CASE("a wrench space is seen through, with its ball, its axes and where it is weakest") {
  const Scene scene = make_wrench_scene({.solid = Shape::make(box(2, 1, 1)),
                                         .axes = {"fx", "fy", "tz"},
                                         .ball = 0.25,
                                         .weakest = Eigen::Vector3d(0, 0, -3)});
  REQUIRE(scene.meshes.size() == 2);
  CHECK(scene.meshes[0].opacity < 1);
  CHECK(scene.meshes[1].shape->closed());
  CHECK(scene.meshes[1].shape->radius() == doctest::Approx(0.25));
  // a sphere of 24 rings lacks half a hundredth of its volume
  CHECK(scene.meshes[1].shape->solid().volume ==
        doctest::Approx(4 * M_PI / 3 * 0.25 * 0.25 * 0.25).epsilon(0.01));
  REQUIRE(scene.arrows.size() == 4);
  for (int k = 0; k < 3; ++k) {
    CHECK(scene.arrows[k].tip[k] > 0.5);
    CHECK(scene.arrows[k].tail[k] < -0.5);
  }
  CHECK(scene.arrows[3].tip.normalized() == Eigen::Vector3d(0, 0, -1));
  CHECK(scene.labels[2].text == "tz");
  CHECK(scene.labels[3].text == "weakest");
}

TEST_CASE("without a ball or a weakest direction there is none") {
  const Scene scene = make_wrench_scene(
      {.solid = Shape::make(box(1, 1, 1)), .weakest = Eigen::Vector3d::Zero().eval()});
  CHECK(scene.meshes.size() == 1);
  CHECK(scene.arrows.size() == 3);
}
