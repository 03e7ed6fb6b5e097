#include "clench/grasp/wrench/grasp_map.h"

#include "grasp/held_object.h"

using namespace clench;
using Eigen::Vector3d;

TEST_CASE("columns of the grasp map are the wrenches of its forces, normal first") {
  const PointContact points[] = {test::contact_at({0.1, 0.2, 0.3}, {0, 0, 1}, 0.5),
                                 test::contact_at({0, 0.1, 0}, {1, 1, 0}, 0),
                                 test::contact_at({0.3, 0, 0}, {1, 2, 3}, 0.5, 0.01)};
  const Vector3d com(0.01, 0.02, 0.03);
  const GraspMap map = grasp_map(points, com);
  CHECK(map.starts == std::vector<int>{0, 3, 4, 8});
  for (int i = 0; i < map.contacts(); ++i) {
    const Eigen::Matrix3d frame = contact_frame(points[i].n_O);
    const Vector3d arm = points[i].p_O - com;
    const Vector3d axes[] = {frame.col(2), frame.col(0), frame.col(1)};
    for (int k = 0; k < std::min(3, force_count(points[i])); ++k) {
      CHECK((map.matrix.col(map.starts[i] + k).head<3>() - axes[k]).norm() < 1e-15);
      CHECK((map.matrix.col(map.starts[i] + k).tail<3>() - arm.cross(axes[k])).norm() < 1e-15);
    }
  }
  CHECK(map.matrix.col(7).head<3>().norm() == 0);
  CHECK((map.matrix.col(7).tail<3>() - points[2].n_O).norm() < 1e-15);
}

TEST_CASE("unit forces of the map are the cone's edges") {
  const PointContact point = test::contact_at({0.1, -0.2, 0.3}, {1, -2, 0.5}, 0.6);
  const GraspMap map = grasp_map(std::span(&point, 1), Vector3d(0, 0.1, 0));
  const auto edges = cone_wrenches(point, {.edges = 8, .rho = 1, .p_OM = {0, 0.1, 0}});
  for (int k = 0; k < 8; ++k) {
    const double a = k * std::numbers::pi / 4;
    const Vector3d f(1, 0.6 * std::cos(a), 0.6 * std::sin(a));
    CHECK((map.matrix * f - edges.col(k)).norm() < 1e-14);
  }
}

TEST_CASE("rotated frames give the same wrenches from forces along the world axes") {
  const PointContact points[] = {test::contact_at({0.1, 0.2, 0.3}, {0, 0, 1}, 0.5),
                                 test::contact_at({0, 0.1, 0}, {1, 1, 0}, 0),
                                 test::contact_at({0.3, 0, 0}, {1, 2, 3}, 0.5, 0.01)};
  const Eigen::Matrix3d R_WO = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.1).normalized().matrix();
  const GraspMap map = grasp_map(points, Vector3d::Zero());
  const Eigen::MatrixXd turns = frame_turns(map, points, R_WO);
  CHECK((turns.transpose() * turns - Eigen::MatrixXd::Identity(8, 8)).norm() < 1e-14);
  const Eigen::MatrixXd turned = map.matrix * turns;
  for (const int i : {0, 2}) {
    const Eigen::Matrix3d frame = contact_frame(R_WO * points[i].n_O);
    for (int k = 0; k < 3; ++k)
      CHECK((R_WO * turned.col(map.starts[i] + k).head<3>() - frame.col((k + 2) % 3)).norm() <
            1e-14);
  }
}
