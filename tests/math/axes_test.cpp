#include "clench/math/axes.h"

#include "clench/base/random.h"
#include "support/meshes.h"

using namespace clench;
using namespace clench::test;
using Eigen::Vector3d;

TEST_CASE(
    "the first axis is exact, the second lies in the plane of both arguments, and the frame is "
    "right-handed") {
  Random random(6, 0);
  for (int trial = 0; trial < 60; ++trial)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if (i == j) continue;
        const Vector3d a = random_direction(random), b = random_direction(random);
        const auto q = rotation_from_axes(i, a * std::exp(random.uniform(-300, 300)), j, 5 * b);
        REQUIRE(q);
        const Eigen::Matrix3d R = q->toRotationMatrix();
        CHECK((R.col(i) - a).norm() < 1e-15 * 8);  // a unit quaternion and back
        CHECK(R.col(j).dot(b) > 0);
        CHECK(std::abs(R.col(j).dot(a.cross(b).normalized())) < 1e-14 / a.cross(b).norm());
        CHECK(R.determinant() == doctest::Approx(1).epsilon(1e-14));
      }
}

TEST_CASE("axes that are zero, parallel or not finite give no rotation") {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), none = Vector3d::Zero();
  CHECK_FALSE(rotation_from_axes(0, none, 1, y));
  CHECK_FALSE(rotation_from_axes(0, x, 1, none));
  CHECK_FALSE(rotation_from_axes(0, x, 1, -3 * x));
  CHECK_FALSE(rotation_from_axes(0, x, 1, x + 1e-10 * y));
  CHECK_FALSE(rotation_from_axes(0, {NAN, 0, 0}, 1, y));
  CHECK_FALSE(rotation_from_axes(0, {INFINITY, 0, 0}, 1, y));
  CHECK(rotation_from_axes(0, x, 1, x + 1e-8 * y));
}
