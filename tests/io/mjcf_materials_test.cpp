// Friction of geoms in an MJCF file that is read as a robot.
#include "clench/base/error.h"
#include "temporary.h"
#include "told_robot.h"
#include "written_robot.h"

using namespace clench;
using namespace clench::test;

namespace {

/// A base and a link `a`, which contain these geoms.
ToldRobot touching_links(const std::string& base, const std::string& a,
                         const std::string& defaults = "") {
  const TemporaryFolder folder;
  return ToldRobot(folder.write(
      "m.xml", "<mujoco model='m'>" + defaults + "<worldbody><body name='base'>" + base +
                   "<body name='a'><joint name='j'/>" + a + "</body></body></worldbody></mujoco>"));
}

std::string sphere_xml(const std::string& attributes) {
  return "<geom type='sphere' size='.01' " + attributes + "/>";
}

}  // namespace

TEST_CASE("links of a robot have the friction that the file gives their geoms") {
  const ToldRobot told =
      touching_links(sphere_xml(""), sphere_xml("friction='0.7 0.1 0.1' priority='2'"));
  CHECK(told.body("base").material == "plastic");
  CHECK(told.body("a").material == "friction 0.7 priority 2");
  CHECK(told.robot.frictions == std::vector<OwnFriction>{{.mu = 0.7, .priority = 2}});
  CHECK(told.warnings.empty());
  CHECK(told.noted("links whose geoms give no friction count as plastic"));
  // by a class
  const ToldRobot all = touching_links(sphere_xml(""), sphere_xml("condim='1'"),
                                       "<default><geom friction='0.4'/></default>");
  CHECK(all.body("base").material == "friction 0.4");
  CHECK(all.body("a").material == "friction 0.4 frictionless");
  CHECK_FALSE(all.noted("count as plastic"));
  // geoms that do not collide are ignored
  const std::string ghost = "friction='3' contype='0' conaffinity='0'";
  CHECK(touching_links(sphere_xml(""), sphere_xml("") + sphere_xml(ghost)).robot.frictions.empty());
}

TEST_CASE("a link whose geoms differ in friction has the prevailing one, with a warning") {
  const ToldRobot told =
      touching_links(sphere_xml(""), sphere_xml("friction='0.2'") + sphere_xml("friction='2'"));
  CHECK(told.body("a").material == "friction 2");
  CHECK(
      told.warned("m.xml: bodies whose geoms differ in friction; the one of the highest "
                  "priority, then the largest, is used for all: "));
  // the default friction of MuJoCo is 1
  const ToldRobot part =
      touching_links(sphere_xml(""), sphere_xml("") + sphere_xml("friction='0.2'"));
  CHECK(part.body("a").material == "friction 1");
  CHECK(part.warnings.size() == 1);
}

TEST_CASE("a robot taken from a scene has the friction of its geoms, too") {
  const TemporaryFolder folder;
  const auto path =
      folder.write("m.xml", "<mujoco><worldbody><body name='x'><joint/>" +
                                sphere_xml("friction='.3'") + "</body><body name='y'><joint/>" +
                                sphere_xml("") + "</body></worldbody></mujoco>");
  ReadOptions options;
  options.body = "x";
  const RobotSpec robot = read_robot(path, options);
  CHECK(robot.frictions == std::vector<OwnFriction>{{.mu = 0.3}});
  CHECK(robot.links.at(0).body.material == "friction 0.3");
}

TEST_CASE("a URDF keeps the friction of links") {
  const TemporaryFolder folder;
  const ToldRobot told = touching_links(sphere_xml("friction='0.4' condim='1'"),
                                        sphere_xml("friction='0.7' priority='-2'"));
  const WrittenRobot again = written(told.robot, folder.path() / "m.urdf");
  CHECK(again.robot.frictions == std::vector{told.robot.frictions[0], told.robot.frictions[1]});
  CHECK(again.robot.base.material == told.robot.base.material);
  CHECK(again.robot.links.at(0).body.material == "friction 0.7 priority -2");
  const auto read_link = [&](const std::string& attributes) {
    return read_robot(folder.write("h.urdf",
                                   "<robot name='h'><link name='palm'/><clench><link "
                                   "name='palm' " +
                                       attributes + "/></clench></robot>"));
  };
  CHECK(read_link("friction='2'").base.material == "friction 2");
  CHECK_THROWS_WITH_AS(read_link("friction='2' material='wood'"),
                       "h.urdf:1: link: friction: expected a material or a friction, got both",
                       Error);
  CHECK_THROWS_WITH_AS(read_link("frictionless='true'"),
                       "h.urdf:1: link: friction: expected a coefficient, got none", Error);
  CHECK_THROWS_WITH_AS(read_link("friction='-1'"),
                       "h.urdf:1: link: friction: expected a number from 0 to 1e+06, got -1",
                       Error);
}
