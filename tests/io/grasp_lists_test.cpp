#include "clench/io/graspit/grasp_lists.h"

#include "clench/base/error.h"
#include "clench/base/random.h"
#include "support/meshes.h"
#include "temporary.h"

using namespace clench;
using namespace clench::test;

// degrees and millimeters cause one or two rounding errors
static constexpr double unit_rounding = 1e-15;

TEST_CASE("pre-grasps are read in meters and radians, their directions made unit") {
  TemporaryFolder folder;
  const auto list = read_pregrasps(folder.write(
      "a.txt", "# from a planner\n[0 80 0][0 -2 0][1 0 0]60\n\n[1,2,3][0 0 1] [0,1,0] +90 # t\n"));
  REQUIRE(list.size() == 2);
  CHECK(list[0].point.y() == doctest::Approx(0.08));
  CHECK(list[0].direction == Eigen::Vector3d(0, -1, 0));
  CHECK(list[1].spread == doctest::Approx(std::acos(0.0)));
}

TEST_CASE("pre-grasps written and read again are the same but for rounding") {
  TemporaryFolder folder;
  Random random(8, 0);
  std::vector<Pregrasp> list;
  for (int i = 0; i < 50; ++i)
    list.push_back({.point = random_point(random, 0.1),
                    .direction = random_direction(random),
                    .thumb = random_direction(random),
                    .spread = random.uniform()});
  write_pregrasps(list, folder.path() / "a.txt");
  const auto back = read_pregrasps(folder.path() / "a.txt");
  REQUIRE(back.size() == list.size());
  for (size_t i = 0; i < list.size(); ++i) {
    CHECK((back[i].point - list[i].point).norm() < unit_rounding);
    CHECK((back[i].direction - list[i].direction).norm() < unit_rounding);
    CHECK((back[i].thumb - list[i].thumb).norm() < unit_rounding);
    CHECK(std::abs(back[i].spread - list[i].spread) < unit_rounding);
  }
}

TEST_CASE("a marker begins another run of planned grasps") {
  TemporaryFolder folder;
  const std::string mark = "0 0 0 0 0 0 0 0 -2\n";
  const auto list = read_planned_grasps(folder.write(
      "a.txt",
      mark + "1 2 3 1 0 0 0 60 0.25\n4 5 6 0 1 0 0 0 -1\n" + mark + "1 2 3 1 0 0 0 0 0\n"));
  REQUIRE(list.size() == 3);
  CHECK(list[0].info.at("run") == 1);
  CHECK(list[0].measures.at("quality") == 0.25);
  CHECK(list[1].X_OH->rotation.x() == 1);
  CHECK(list[2].info.at("run") == 2);
  // files of a single run may omit it
  CHECK(read_planned_grasps(folder.write("b.txt", "1 2 3 1 0 0 0 60 0.25\n"))[0].info.at("run") ==
        1);
}

TEST_CASE("planned grasps written and read again are the same, runs and all") {
  TemporaryFolder folder;
  Random random(8, 1);
  std::vector<GraspSpec> list(50);
  for (size_t i = 0; i < list.size(); ++i) {
    list[i].X_OH = random_pose(random, 0.1);
    list[i].info = {{"run", 1.0 + static_cast<double>(i / 20)}, {"spread", random.uniform()}};
    list[i].measures = {{"quality", random.uniform()}};
  }
  write_planned_grasps(list, folder.path() / "a.txt");
  const auto back = read_planned_grasps(folder.path() / "a.txt");
  REQUIRE(back.size() == list.size());
  for (size_t i = 0; i < list.size(); ++i) {
    CHECK(back[i].info.at("run") == list[i].info.at("run"));
    CHECK((back[i].X_OH->position - list[i].X_OH->position).norm() < unit_rounding);
    CHECK(back[i].X_OH->rotation.coeffs() == list[i].X_OH->rotation.coeffs());
    CHECK(std::abs(back[i].info.at("spread") - list[i].info.at("spread")) < unit_rounding);
    CHECK(back[i].measures == list[i].measures);
  }
  std::swap(list.front(), list.back());
  CHECK_THROWS_WITH_AS(write_planned_grasps(list, folder.path() / "a.txt"),
                       "a.txt: expected runs in their order", Error);
}

TEST_CASE("more numbers than a planned grasp has are a warning") {
  TemporaryFolder folder;
  Warnings warnings;
  read_planned_grasps(folder.write("a.txt", "1 2 3 1 0 0 0 60 0.25 7\n"), warnings.options());
  CHECK(warnings.list == std::vector<std::string>{"a.txt:1: 1 surplus word is not used"});
}
