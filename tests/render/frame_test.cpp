#include "clench/render/view/frame.h"

#include <cmath>
#include <limits>

#include "clench/base/random.h"
#include "clench/math/decompositions.h"
#include "pictures.h"

using namespace clench;
using namespace clench::test;

namespace {

// widest part of the frame that the vertices reach, 1 at its edge; not finite if one is behind the
// eye
double reach(const Scene& scene, const Eye& eye, double aspect) {
  const Eigen::Matrix4d to_clip = view_projection(eye, aspect, 1e-3, 1e3);
  double most = 0;
  for (const DrawMesh& mesh : scene.meshes)
    for (const auto& p : mesh.shape->mesh().vertices) {
      const Eigen::Vector4d clip = to_clip * (mesh.X_WM * p).homogeneous();
      if (clip.w() <= 0) return std::numeric_limits<double>::infinity();
      most = std::max({most, std::abs(clip.x() / clip.w()), std::abs(clip.y() / clip.w())});
    }
  return most;
}

}  // namespace

TEST_CASE("every vertex is inside the picture, and the picture is used") {
  for (const Eigen::Vector3d& size : {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(5, 0.1, 0.1),
                                      Eigen::Vector3d(0.1, 0.1, 4), Eigen::Vector3d(3, 3, 0.01)})
    for (const double scale : {1e-3, 1.0, 1e3})
      for (const double aspect : {0.4, 1.0, 2.5}) {
        Scene scene;
        const Eigen::Vector3d s = scale * size;
        scene.meshes.push_back(
            solid(box(s.x(), s.y(), s.z()), {1, 1, 1}, Pose::translation({3 * scale, 0, 0})));
        scene.meshes.push_back(
            solid(ball(0.2 * scale), {1, 1, 1}, Pose::translation({2 * scale, scale, 0})));
        const double used = reach(scene, frame_all(scene, aspect), aspect);
        // a margin of 16 % is expected; 1e-5 for corners stored as floats
        CHECK(used < 0.84 + 1e-5);
        CHECK(used > 0.84 - 1e-5);
      }
}

TEST_CASE("a view is from above, and does not depend on the distance of a scene from the origin") {
  Scene scene;
  scene.meshes.push_back(solid(box(1, 2, 3)));
  const Eye here = frame_all(scene, 1.3);
  CHECK(here.eye.z() > here.target.z());
  CHECK(here.up == Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d away(1024, -2048, 512);
  scene.meshes[0].X_WM = Pose::translation(away);
  const Eye there = frame_all(scene, 1.3);
  // integers and halves are added exactly
  CHECK((there.eye - here.eye - away).norm() < 1e-9);
  CHECK((there.target - here.target - away).norm() < 1e-9);
}

TEST_CASE("the view is from the side that shows transparent objects") {
  // a wall on the default's side of a glass ball
  Scene scene;
  scene.meshes.push_back(solid(ball(0.3)));
  scene.meshes[0].opacity = 0.3f;
  const Eye open = frame_all(scene, 1);
  Eigen::Vector3d side = open.eye - open.target;
  side.z() = 0;
  side.normalize();
  const Pose X_WM{shortest_rotation(Eigen::Vector3d::UnitX(), side), 0.6 * side};
  scene.meshes.push_back(solid(box(0.1, 2, 2), {1, 1, 1}, X_WM));
  const Eye moved = frame_all(scene, 1);
  // the ball's center as seen from the eye is not behind the wall's plane
  CHECK(moved.eye.dot(side) < 0.6 + 1);
  CHECK((moved.eye - moved.target).normalized().dot(side) < 0.5);
}

TEST_CASE(
    "a view is from the side where contacts are visible, also if the objects that hide them are "
    "transparent") {
  // a glass ball in a cup that is open towards one side, in which the contacts are
  for (const double angle : {0.3, 1.7, 2.9, 4.4}) {
    const Eigen::Vector3d open(std::cos(angle), std::sin(angle), 0);
    Scene scene;
    scene.meshes.push_back(solid(ball(0.3)));
    scene.meshes[0].opacity = 0.3f;
    for (int k = 1; k < 8; ++k) {
      const double at = angle + 2 * 3.14159265 * k / 8;
      const Eigen::Vector3d side(std::cos(at), std::sin(at), 0);
      const Pose X_WM{shortest_rotation(Eigen::Vector3d::UnitX(), side), 0.5 * side};
      scene.meshes.push_back(solid(box(0.05, 0.4, 1.2), {1, 1, 1}, X_WM));
      scene.meshes.back().opacity = 0.2f;
      scene.meshes.back().hides = true;
    }
    for (const double z : {-0.1, 0.0, 0.1}) scene.spots.push_back({0, 0, z});
    const Eye eye = frame_all(scene, 1);
    Eigen::Vector3d from = eye.eye - eye.target;
    from.z() = 0;
    CHECK(from.normalized().dot(open) > 0.8);
  }
}

TEST_CASE("points to include are in the frame, for any meshes") {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene;
    scene.meshes.push_back(solid(box(0.1, 0.2, 0.1)));
    for (int i = 0; i < 10; ++i)
      scene.held.push_back({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const Eye eye = frame_all(scene, 1.4);
    const Eigen::Matrix4d to_clip = view_projection(eye, 1.4, 1e-3, 1e3);
    for (const auto& p : scene.held) {
      const Eigen::Vector4d clip = to_clip * p.homogeneous();
      CHECK(std::abs(clip.x()) < 0.85 * clip.w());
      CHECK(std::abs(clip.y()) < 0.85 * clip.w());
    }
  }
}

TEST_CASE("unframed meshes may leave the frame, and the view is not from their side") {
  Scene scene;
  scene.meshes.push_back(solid(ball(0.1)));
  const Eye alone = frame_all(scene, 1.2);
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-0.5, 0.6, 0.2),
                                    Eigen::Vector3d(0.4, -0.8, 0.3)}) {
    scene.meshes.resize(1);
    scene.meshes.push_back(solid(box(0.3, 0.3, 0.3), {1, 1, 1}, Pose::translation(at)));
    scene.meshes[1].framed = false;
    const Eye eye = frame_all(scene, 1.2);
    const double distance = (eye.eye - eye.target).norm();
    CHECK(distance == doctest::Approx((alone.eye - alone.target).norm()).epsilon(0.05));
    CHECK((eye.eye - eye.target).normalized().dot(at.normalized()) < 0.75);
  }
}

TEST_CASE("an orthographic view contains everything as well") {
  for (const double aspect : {0.5, 2.0}) {
    Scene scene;
    scene.meshes.push_back(solid(box(0.2, 1, 3), {1, 1, 1}, Pose::translation({5, 5, 5})));
    const Eye eye = frame_all(scene, aspect, true);
    CHECK(eye.ortho_height > 0);
    CHECK(reach(scene, eye, aspect) == doctest::Approx(0.84).epsilon(1e-4));
  }
}

TEST_CASE(
    "axes form a rotation whose z axis points from the target to the eye, for any up vector") {
  Eye eye;
  for (const Eigen::Vector3d& at :
       {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(0, 0, -1e-9)})
    for (const Eigen::Vector3d& up :
         {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3)}) {
      eye.eye = at;
      eye.up = up;
      const Eigen::Matrix3d axes = view_axes(eye);
      // products of unit vectors are rounded in the last bits
      CHECK((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm() < 1e-12);
      CHECK(axes.determinant() == doctest::Approx(1));
      CHECK((axes.col(2) - at.normalized()).norm() < 1e-12);
    }
}

TEST_CASE("a view that is shifted aside moves all points by this fraction of the height") {
  const double aspect = 1.5;
  for (const double ortho_height : {0.0, 2.0}) {
    Eye eye{.eye = {3, 1, 2}, .ortho_height = ortho_height};
    const Eigen::Matrix4d straight = view_projection(eye, aspect, 0.1, 10);
    eye.aside = 0.2;
    const Eigen::Matrix4d shifted = view_projection(eye, aspect, 0.1, 10);
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.4, -1, 0.3), Eigen::Vector3d(-2, 1, 1)}) {
      const Eigen::Vector4d from = straight * p.homogeneous(), to = shifted * p.homogeneous();
      // from -1 to 1 across the width
      const Eigen::Vector3d move = to.head<3>() / to.w() - from.head<3>() / from.w();
      CHECK((move - Eigen::Vector3d(2 * 0.2 / aspect, 0, 0)).norm() < 1e-12);
    }
    eye.aside = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH_AS(view_axes(eye), "picture: the shift of a view must be finite, got inf",
                         Error);
  }
}

TEST_CASE("an empty scene has a view, and an invalid aspect ratio is rejected") {
  const Eye eye = frame_all({}, 1.5);
  CHECK(eye.eye.allFinite());
  CHECK((eye.eye - eye.target).norm() > 0.1);
  CHECK_THROWS_WITH_AS(frame_all({}, 0), "picture: aspect must be > 0, got 0", Error);
}
