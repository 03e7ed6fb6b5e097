#include "scene/force_arrows.h"

using namespace clench;
using Eigen::Vector3d;

TEST_CASE("a force's arrow ends where it presses, as long as it is strong") {
  const PlacedForce forces[] = {
      {{0.1, 0, 0}, {-2, 0, 0}}, {{0, 0.1, 0}, {0, -1, 0}}, {{0, 0, 1}, {0, 0, 1e-4}}};
  const double scale = force_scale(forces, 0.05);
  CHECK(scale == doctest::Approx(0.025));
  const auto arrows = force_arrows(forces, scale);
  REQUIRE(arrows.size() == 2);  // the third one would not be seen
  for (int i = 0; i < 2; ++i) {
    CHECK((arrows[i].tip - forces[i].p_W).norm() == 0);
    CHECK((arrows[i].tail - (forces[i].p_W - scale * forces[i].f_W)).norm() < 1e-15);
    CHECK(arrows[i].radius > 0);
  }
  CHECK(force_arrows({}, 1).empty());
  CHECK(force_scale({}, 0.05) == 1);
}
