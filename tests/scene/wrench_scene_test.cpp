#include "clench/scene/wrench_scene.h"

#include <doctest/doctest.h>

#include <set>

#include "support/shapes.h"

using namespace clench;
using namespace clench::test;

TEST_CASE("a wrench space is transparent, with its ball, its axes and its weakest direction") {
  const Scene scene = make_wrench_scene({.solid = Shape::make(box(2, 1, 1)),
                                         .axes = {"fx", "fy", "tz"},
                                         .ball = 0.25,
                                         .weakest = Eigen::Vector3d(0, 0, -3)});
  REQUIRE(scene.meshes.size() == 2);
  CHECK(scene.meshes[0].opacity < 1);
  CHECK(scene.meshes[1].shape->closed());
  CHECK(scene.meshes[1].shape->radius() == doctest::Approx(0.25));
  // a sphere of 24 rings lacks half a percent of its volume
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

TEST_CASE("a solid without size has axes without numbers") {
  const Mesh point{.vertices = {{0, 0, 0}}, .triangles = {{0, 0, 0}}};
  const Scene scene = make_wrench_scene({.solid = Shape::make(point)});
  CHECK(scene.labels.size() == 3);
}

TEST_CASE("a ball and a weakest direction are shown only if they exist") {
  const Scene scene = make_wrench_scene(
      {.solid = Shape::make(box(1, 1, 1)), .weakest = Eigen::Vector3d::Zero().eval()});
  CHECK(scene.meshes.size() == 1);
  CHECK(scene.arrows.size() == 3);
}

TEST_CASE("numbers are at round steps along the axes, and the ball shows its radius") {
  for (const double scale : {1.0, 1e-3, 40.0}) {
    const Scene scene = make_wrench_scene({.solid = Shape::make(box(2 * scale, scale, scale)),
                                           .axes = {"fx", "fy", "fz"},
                                           .ball = 0.25 * scale,
                                           .title = "a title",
                                           .epsilon = 0.25 * scale});
    REQUIRE(scene.labels.size() > 4);
    CHECK(scene.labels[3].text == fmt::format("radius {:.3g}", 0.25 * scale));
    REQUIRE(scene.caption.size() == 2);
    CHECK(scene.caption[0] == "a title");
    CHECK(scene.caption[1].starts_with(fmt::format("epsilon {:.4g} N", 0.25 * scale)));
    // one tick each, on its axis, at the position of its number
    REQUIRE(scene.cones.size() == scene.labels.size() - 4);
    std::set<std::pair<int, double>> seen;
    for (size_t i = 0; i < scene.cones.size(); ++i) {
      const double value = std::stod(scene.labels[4 + i].text);
      int axis = 0;
      scene.cones[i].apex.cwiseAbs().maxCoeff(&axis);
      CHECK(scene.cones[i].apex.isApprox(value * Eigen::Vector3d::Unit(axis)));
      CHECK(scene.labels[4 + i].color == scene.arrows[axis].color);
      CHECK(scene.cones[i].apex[axis] < scene.arrows[axis].tip[axis]);
      CHECK(scene.cones[i].apex[axis] > scene.arrows[axis].tail[axis]);
      seen.insert({axis, value});
    }
    CHECK(seen.size() == scene.cones.size());
    // the solid spans from -1 to 1, -0.5 to 0.5 of the scale: steps of a half
    for (int axis = 0; axis < 3; ++axis) CHECK(seen.count({axis, 0.5 * scale}) == 1);
    CHECK(seen.count({0, -scale}) == 1);
  }
}
