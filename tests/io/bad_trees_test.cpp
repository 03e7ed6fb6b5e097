// Every URDF and MJCF file of tests/data/bad is rejected with the message in the file next to it.
#include <algorithm>

#include "bad_files.h"
#include "clench/io/read/read.h"
#include "temporary.h"

using namespace clench;
using clench::test::check_bad_files;
using clench::test::TemporaryFolder;
namespace fs = std::filesystem;

static void check_trees(const std::string& format) {
  check_bad_files(format, "", "." + format, 20, [](const fs::path& path) { read_robot(path); });
}

TEST_CASE("a malformed URDF file is told by file, line, expected and got") { check_trees("urdf"); }
TEST_CASE("a malformed MJCF file is told by file, line, expected and got") { check_trees("mjcf"); }

TEST_CASE("an unexpanded xacro file is told to be expanded") {
  TemporaryFolder folder;
  const auto file = folder.write("hand.urdf.xacro", "<robot/>");
  CHECK_THROWS_WITH_AS(
      read_robot(file),
      "hand.urdf.xacro: a xacro file must be expanded first: xacro hand.urdf.xacro > robot.urdf",
      Error);
}

TEST_CASE("more links, joints or geoms than any robot has are refused") {
  TemporaryFolder folder;
  const auto many = [&](const std::string& head, const std::string& part, int count,
                        const std::string& tail) {
    std::string text = head;
    for (int i = 0; i < count; ++i) {
      std::string p = part;
      for (size_t at; (at = p.find('#')) != std::string::npos;) p.replace(at, 1, std::to_string(i));
      text += p;
    }
    return text + tail;
  };
  const auto refused = [&](const std::string& name, const std::string& text, const char* sentence) {
    CHECK_THROWS_WITH_AS(read_robot(folder.write(name, text)), sentence, Error);
  };
  refused("a.urdf", many("<robot>", "<link name='l#'/>", 1001, "</robot>"),
          "a.urdf:1: expected at most 1000 links");
  refused("a.urdf",
          many("<robot><link name='a'/>",
               "<link name='l#'/><joint name='j#' type='fixed'><parent link='a'/><child "
               "link='l#'/></joint>",
               1001, "</robot>"),
          "a.urdf:1: expected at most 1000 links");
  refused("a.mjcf",
          many("<mujoco><worldbody><body>", "<body/>", 1001, "</body></worldbody></mujoco>"),
          "a.mjcf:1: expected at most 1000 bodies");
  refused("a.mjcf",
          many("<mujoco><worldbody><body><body>", "<joint name='j#' range='0 1'/>", 1001,
               "</body></body></worldbody></mujoco>"),
          "a.mjcf:1: expected at most 1000 joints");
  refused(
      "a.mjcf",
      many("<mujoco><worldbody><body>", "<geom size='1'/>", 20001, "</body></worldbody></mujoco>"),
      "a.mjcf:1: expected at most 20000 geoms");
}

TEST_CASE("a circle of includes over several files is found") {
  TemporaryFolder folder;
  folder.write("b.xml", "<mujoco><include file='c.xml'/></mujoco>");
  folder.write("c.xml", "<mujoco>\n<include file='b.xml'/></mujoco>");
  const auto file = folder.write("a.xml", "<mujoco><include file='b.xml'/></mujoco>");
  CHECK_THROWS_WITH_AS(read_robot(file), "c.xml:2: include: 'b.xml' includes itself", Error);
}

TEST_CASE("how a hand closes and approaches may be said of robots of every format") {
  ReadOptions options;
  options.closing = {{"1", -1}, {"2", 0}};
  options.approach = approach_frame({0, 0, 1}, {0, 1, 0});
  const fs::path cfg = "tests/data/two_finger/claw.cfg";
  const RobotSpec plain = read_robot(cfg), chosen = read_robot(cfg, options);
  CHECK(chosen.dofs[0].default_velocity == -std::abs(plain.dofs[0].default_velocity));
  CHECK(chosen.dofs[1].default_velocity == 0);
  CHECK(*chosen.X_BA == *options.approach);
}

TEST_CASE("options that name no DOF, or no number, are refused by name") {
  ReadOptions options;
  const fs::path gripper = "tests/data/urdf/gripper.urdf";
  options.packages["gripper_description"] = "tests/data/urdf";
  options.closing["left_slid"] = 1;
  CHECK_THROWS_WITH_AS(
      read_robot(gripper, options),
      "gripper.urdf: close: expected the name of a DOF or a number from 1 to 1, got "
      "'left_slid'; did you mean 'left_slide'?",
      Error);
  options.closing = {{"1", NAN}};
  CHECK_THROWS_WITH_AS(read_robot(gripper, options),
                       "gripper.urdf: close: 1: expected 1, -1 or 0, got nan", Error);
}
