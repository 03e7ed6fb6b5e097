#include "clench/io/graspit/glove_files.h"

#include "clench/base/error.h"
#include "support/shared.h"
#include "temporary.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::Warnings;

TEST_CASE("a calibration gives slopes a row per DOF, and intercepts") {
  TemporaryFolder folder;
  Warnings warnings;
  const auto glove = read_glove_calibration(
      folder.write("g.txt", "2 3\n1 2 3\n4 5 6\n-1 -2\nrest\n"), warnings.options());
  REQUIRE(glove.slopes.rows() == 2);
  REQUIRE(glove.slopes.cols() == 3);
  CHECK(glove.slopes(1, 0) == 4);
  CHECK(glove.intercepts == Eigen::Vector2d(-1, -2));
  CHECK(warnings.list == std::vector<std::string>{"g.txt:5: text from 'rest' on is not used"});
}

TEST_CASE("the calibrations of the original load, for each of its human hands") {
  REQUIRE_SHARED();
  for (const auto& [name, dofs] :
       {std::pair("calibration_best_aa.txt", 20), {"calibration_best_no_dip_aa.txt", 16}}) {
    const auto glove = read_glove_calibration(
        test::shared() / "data/graspit/models/robots/HumanHand/cyberglove" / name);
    CHECK(glove.slopes.rows() == dofs);
    CHECK(glove.slopes.cols() == 24);
    CHECK(glove.intercepts.size() == dofs);
    // bent fingers raise the raw readings: at 255 each, no joint is turned beyond twice its range
    CHECK((glove.intercepts + glove.slopes * Eigen::VectorXd::Constant(24, 255))
              .cwiseAbs()
              .maxCoeff() < 12);
  }
}

TEST_CASE("poses have what their flags say, and a quaternion that ends in w") {
  TemporaryFolder folder;
  const auto poses = read_glove_poses(
      folder.write("p.txt",
                   "2\n3\n12.5\n1\n10 20 30\n1\n0 -1 2\n1\n0.1 0.2 0.3\n0 0 1 0\n1 2 3\n"
                   "2 -1 0 0 0  0 0 0 1  0 0 0\n"));
  REQUIRE(poses.size() == 2);
  CHECK(*poses[0].distance == doctest::Approx(0.0125));
  CHECK(poses[0].sensors == std::vector<int>{10, 20, 30});
  CHECK(poses[0].dof_of_sensor == std::vector<int>{0, -1, 2});
  CHECK(poses[0].joints == std::vector<double>{0.1, 0.2, 0.3});
  CHECK(poses[0].pose.rotation.z() == 1);
  CHECK(poses[0].pose.position.x() == doctest::Approx(0.001));
  CHECK_FALSE(poses[1].distance);
  CHECK(poses[1].sensors.empty());
  CHECK(poses[1].pose.rotation.w() == 1);
}
