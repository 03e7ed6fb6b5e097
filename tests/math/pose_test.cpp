#include "clench/math/pose.h"

#include <numbers>

#include "clench/base/random.h"
#include "clench/math/rpy.h"

using namespace clench;

static Pose random_pose(Random& random) {
  const Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized(),
          {random.normal(), random.normal(), random.normal()}};
}

// products of unit quaternions are rounded in the last bits only
static constexpr double pose_rounding = 1e-14;

TEST_CASE("poses compose like their matrices") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Pose X_AB = random_pose(random), X_BC = random_pose(random);
    const Eigen::Vector3d p_C(random.normal(), random.normal(), random.normal());
    CHECK(((X_AB * X_BC) * p_C - X_AB * (X_BC * p_C)).norm() < pose_rounding * 10);
    CHECK(((X_AB * X_BC).matrix() - X_AB.matrix() * X_BC.matrix()).norm() < pose_rounding);
  }
}

TEST_CASE("a pose times its inverse is the identity") {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Pose X = random_pose(random), nothing = X * X.inverse();
    CHECK(nothing.position.norm() < pose_rounding);
    CHECK(nothing.angle() < pose_rounding);
  }
}

TEST_CASE("the angle is that of the rotation, including small ones") {
  for (const double angle : {1e-12, 1e-3, 1.0, 3.0, std::numbers::pi}) {
    const Pose X = Pose::turn(angle, Eigen::Vector3d(1, 2, 3).normalized());
    CHECK(X.angle() == doctest::Approx(angle).epsilon(1e-12));
  }
  CHECK(Pose::turn(4.0, Eigen::Vector3d::UnitX()).angle() ==
        doctest::Approx(2 * std::numbers::pi - 4));
}

TEST_CASE("interpolation starts and ends at the given poses and rotates uniformly") {
  Random random(3);
  const Pose a = random_pose(random), b = random_pose(random);
  CHECK((interpolate(a, b, 0).position - a.position).norm() == 0);
  CHECK((a.inverse() * interpolate(a, b, 0)).angle() < 1e-7);  // acos near 1 loses half the digits
  CHECK((b.inverse() * interpolate(a, b, 1)).angle() < 1e-7);
  const double whole = (a.inverse() * b).angle(),
               half = (a.inverse() * interpolate(a, b, 0.5)).angle();
  CHECK(half == doctest::Approx(whole / 2));
}

TEST_CASE("a pose with a number that is not finite is detected") {
  Pose X;
  CHECK(X.is_finite());
  X.position.y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(X.is_finite());
}

TEST_CASE("the hash of a pose depends on every number") {
  const auto hash = [](const Pose& X) {
    Hasher h;
    add(h, X);
    return h.value();
  };
  const Pose still;
  for (int i = 0; i < 3; ++i) {
    Pose X;
    X.position[i] = 1e-300;
    CHECK(hash(X) != hash(still));
    CHECK_FALSE(X == still);
  }
  CHECK(hash(Pose()) == hash(still));
}

TEST_CASE(
    "roll, pitch and yaw reproduce the rotation, also at and near a pitch of a quarter turn") {
  Random random(8);
  const double pi = 3.14159265358979323846;
  const auto turned = [](const Eigen::Vector3d& rpy) {
    return Eigen::Matrix3d(Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                           Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()));
  };
  for (int i = 0; i < 500; ++i) {
    const double lean = std::pow(10, random.uniform(-16, 0)), side = i % 2 ? 1 : -1;
    const double pitch = i % 3 ? side * (pi / 2 - lean) : random.uniform(-pi / 2, pi / 2);
    const Eigen::Matrix3d R = turned({random.uniform(-pi, pi), pitch, random.uniform(-pi, pi)});
    CHECK((turned(rpy_of(R)) - R).norm() < 4e-12);  // the cosine that is treated as 0, and rounding
  }
  CHECK(rpy_of(turned({0, pi / 2, 0.3})).isApprox(Eigen::Vector3d(0, pi / 2, 0.3), 1e-12));
}
