// Joints of a URDF that mimic joints which are missing or do not move.
#include <fmt/format.h>

#include "clench/base/error.h"
#include "support/chains.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::ToldRobot;

/// Links a, b, c, d in a chain, connected by joints i, j and k with given contents.
static std::string chain_of_four(const std::string& i, const std::string& j, const std::string& k) {
  std::string text = "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>";
  text += "<link name='d'/>\n";
  const std::string* inside[] = {&i, &j, &k};
  for (int n = 0; n < 3; ++n)
    text += fmt::format("<joint name='{}' {}<parent link='{}'/><child link='{}'/></joint>\n",
                        "ijk"[n], *inside[n], "abc"[n], "bcd"[n]);
  return text + "</robot>";
}

static const std::string turning = "type='continuous'><axis xyz='0 0 1'/>";

TEST_CASE("a joint that mimics a missing one moves independently") {
  const TemporaryFolder folder;
  const ToldRobot told(
      folder.write("a.urdf", chain_of_four(turning, turning + "<mimic joint='h' multiplier='3'/>",
                                           turning + "<mimic joint='j' multiplier='2'/>")));
  REQUIRE(told.robot.dofs.size() == 2);
  CHECK(told.joint("j").dof == 1);
  CHECK(told.joint("j").ratio == 1);
  CHECK(told.joint("k").dof == 1);
  CHECK(told.joint("k").ratio == 2);
  CHECK(told.warned("a.urdf:3: joint 'j': mimic: no joint is called 'h'; it moves independently"));

  const ToldRobot near(
      folder.write("b.urdf",
                   "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>\n"
                   "<joint name='finger_1' type='continuous'><parent link='a'/><child link='b'/>"
                   "</joint><joint name='finger_2' type='continuous'><parent link='a'/>"
                   "<child link='c'/><mimic joint='fingre_1'/></joint></robot>"));
  CHECK(near.robot.dofs.size() == 2);
  CHECK(
      near.warned("b.urdf:2: joint 'finger_2': mimic: no joint is called 'fingre_1'; did you "
                  "mean 'finger_1'?; it moves independently"));
}

TEST_CASE("a joint that mimics one that does not move is fixed at its offset") {
  const TemporaryFolder folder;
  const std::string follower = turning + "<mimic joint='i' multiplier='3' offset='0.5'/>";
  for (const std::string type : {"fixed", "floating", "planar"}) {
    CAPTURE(type);
    const ToldRobot told(
        folder.write("a.urdf", chain_of_four("type='" + type + "'>", follower, turning)));
    CHECK(told.robot.dofs.size() == 1);
    CHECK(joints_of(told.robot).size() == 1);
    CHECK(told.link("c").X_JL.angle() == doctest::Approx(0.5));
    CHECK(
        told.warned("a.urdf:3: joint 'j' mimics 'i', which does not move; it is fixed at 0.5 "
                    "rad"));
  }
}

TEST_CASE("a follower of a follower that does not move is fixed, too") {
  const TemporaryFolder folder;
  // the first joint of the file follows the second, which follows the third
  const ToldRobot told(folder.write(
      "a.urdf", chain_of_four("type='prismatic'><axis xyz='0 0 1'/><mimic joint='j' multiplier='2' "
                              "offset='0.25'/>",
                              turning + "<mimic joint='k' offset='0.5'/>", "type='fixed'>")));
  CHECK(told.robot.dofs.empty());
  CHECK(told.link("b").X_JL.position.z() == doctest::Approx(1.25));
  CHECK(told.link("c").X_JL.angle() == doctest::Approx(0.5));
  CHECK(
      told.warned("a.urdf:3: joint 'j' mimics 'k', which does not move; it is fixed at 0.5 rad "
                  "(1 more alike)"));
}

TEST_CASE("a joint that would be fixed infinitely far away is refused") {
  const TemporaryFolder folder;
  std::string text =
      "<robot name='r'><link name='l0'/><link name='l1'/><joint name='j1' "
      "type='fixed'><parent link='l0'/><child link='l1'/></joint>\n";
  for (int n = 2; n < 30; ++n)
    text += fmt::format(
        "<link name='l{0}'/><joint name='j{0}' type='continuous'><parent link='l{1}'/><child "
        "link='l{0}'/><mimic joint='j{1}' multiplier='1e15' offset='1'/></joint>\n",
        n, n - 1);
  CHECK_THROWS_WITH_AS(ToldRobot(folder.write("a.urdf", text + "</robot>")),
                       "a.urdf:23: joint 'j23': expected a finite position, got inf", Error);
}
