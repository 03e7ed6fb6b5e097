#include "clench/render/view/lights.h"

#include <cmath>

using namespace clench;

TEST_CASE("a room's lights surround the scene, and each half of the ball gives a total of one") {
  for (const int count : {24, 128, 500}) {
    const auto room = place_room(count);
    CHECK(room.size() == static_cast<size_t>(count));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double above = 0, below = 0;
    for (const Light& light : room) {
      CHECK(light.to_light.norm() == doctest::Approx(1));
      sum += light.share * light.to_light.cast<double>();
      (light.to_light.z() > 0 ? above : below) += light.share * std::abs(light.to_light.z());
    }
    // the mean of the cosine over a half ball is 1/2, and the shares of a half add up to 2
    CHECK(above == doctest::Approx(1).epsilon(0.02));
    CHECK(below == doctest::Approx(1).epsilon(0.02));
    // evenly spread: no side is preferred; the spiral is uneven by less than one part in its count
    CHECK(sum.norm() < 8.0 / count);
  }
}

TEST_CASE("a lamp shines from above on the viewer's left, also if the view is straight down") {
  Eigen::Matrix3d level, down;
  level << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // right x, up z, back -y
  down.setIdentity();                   // right x, up y, back z
  for (const auto& axes : {level, down}) {
    const auto lamp = place_lamp(axes, 32);
    float sum = 0;
    for (const Light& light : lamp) {
      CHECK(light.to_light.z() > 0.5f);
      CHECK(light.to_light.x() < -0.2f);
      sum += light.share;
    }
    CHECK(sum == doctest::Approx(1));
  }
}

TEST_CASE(
    "samples are balanced about the center of the pixel and overlap its neighbors, but not "
    "beyond") {
  CHECK(place_samples(1).front().isZero());
  for (const int count : {1, 4, 8, 16, 64}) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const auto& p : place_samples(count)) {
      CHECK(p.cwiseAbs().maxCoeff() < 1.5);
      sum += p;
    }
    // the mean is subtracted: only rounding remains
    CHECK(sum.norm() < 1e-12 * count);
  }
}
