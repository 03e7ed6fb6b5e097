#include "clench/grasp/force/preload.h"

#include "clench/base/error.h"
#include "grasp/jaws.h"

using namespace clench;
using Eigen::Vector2d;
using test::Jaws, test::jaws, test::wrench;

static Preload ask(const Jaws& j, const PreloadOptions& options) {
  return optimal_preload(j.world, j.grasp, options);
}

TEST_CASE("a preload presses as the largest load across the jaws requires") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 10);
  const Preload p = ask(j, {.loads = {wrench(0, 0, 0, 0, 0, 0), wrench(0, 3, -4, 0, 0, 0)}});
  REQUIRE(p.status == ConeStatus::optimal);
  CHECK((p.efforts - Vector2d(5, 5)).norm() < 1e-6);
  CHECK(std::abs(p.fraction - 0.5) < 1e-7);
  REQUIRE(p.normals.size() == 2);
  for (const auto& normals : p.normals) CHECK((normals - Vector2d(5, 5)).norm() < 1e-6);
  CHECK(ask(j, {.loads = {wrench(0, 0, -10.1, 0, 0, 0)}}).status == ConeStatus::infeasible);
}

TEST_CASE("springs share the preload") {
  const Jaws j = jaws(DofKind::compliant, 0.5, 100, false, 100);  // 3 N at q = 0.07
  const Preload p = ask(j, {.loads = {wrench(0, 0, 0, 0, 0, 0), wrench(0, 0, -5, 0, 0, 0)}});
  REQUIRE(p.status == ConeStatus::optimal);
  CHECK((p.efforts - Vector2d(2, 2)).norm() < 1e-6);
}

TEST_CASE("locked jaws share a load along them") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 10);
  PreloadOptions options{.loads = {wrench(0, 0, -2, 0, 0, 0), wrench(8, 0, 0, 0, 0, 0)}};
  CHECK(ask(j, options).status == ConeStatus::infeasible);
  options.locked = true;
  const Preload p = ask(j, options);
  REQUIRE(p.status == ConeStatus::optimal);
  // the jaw that is relieved keeps contact
  CHECK((p.efforts - Vector2d(4, 4)).norm() < 1e-6);
  CHECK((p.normals[0] - Vector2d(4, 4)).norm() < 1e-6);
  CHECK((p.normals[1] - Vector2d(8, 0)).norm() < 1e-6);
}

TEST_CASE("elastic responses are the smallest forces that balance the load") {
  const test::Held h = test::held(test::around_ball(5, 0.5, 3, 0.01));
  const GraspMap map = grasp_map(h.grasp.points, h.grasp.com);
  const Vector6d load = wrench(1, -2, 3, 0.02, 0.03, -0.01);
  const Eigen::VectorXd f = elastic_response(h.grasp, load);
  CHECK((map.matrix * f + load).norm() < 1e-12 * load.norm());
  // orthogonal to all forces without a resultant: f = units^2 G^T y
  Eigen::VectorXd squares = Eigen::VectorXd::Ones(f.size());
  for (int i = 0; i < map.contacts(); ++i) squares[map.starts[i] + 3] = 0.01 * 0.01;
  const Eigen::MatrixXd m = map.matrix * squares.asDiagonal() * map.matrix.transpose();
  const Eigen::VectorXd y = m.fullPivLu().solve(-load);
  CHECK((squares.asDiagonal() * map.matrix.transpose() * y - f).norm() < 1e-9 * f.norm());
  // two hard fingers resist no torque about their line
  CHECK(elastic_response(test::held(test::pinch(0.5)).grasp, wrench(0, 0, 0, 1, 0, 0)).size() == 0);
}

TEST_CASE("given torques limit the largest load") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 10);
  JointDemand joints;
  joints.efforts = Vector2d(3, 3);
  ForceOptions options{.load = wrench(0, 0, -1, 0, 0, 0), .joints = joints};
  CHECK(std::abs(max_load(j.world, j.grasp, options).load_factor - 3) < 1e-6);
  options.load = wrench(1, 0, 0, 0, 0, 0);
  CHECK(max_load(j.world, j.grasp, options).load_factor < 1e-6);
}

TEST_CASE("a preload without loads is rejected, and so are invalid loads") {
  const Jaws j = jaws(DofKind::rigid, 0.5, 10);
  CHECK_THROWS_WITH_AS(ask(j, PreloadOptions{}), "optimal preload: expected at least one load, got none", Error);
  PreloadOptions options{.loads = {wrench(0, 0, std::numeric_limits<double>::infinity(), 0, 0, 0)}};
  CHECK_THROWS_WITH_AS(ask(j, options), "contact forces: load holds a number that is not finite",
                       Error);
}
