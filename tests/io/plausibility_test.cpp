#include "clench/spec/plausibility.h"

#include <fmt/format.h>

#include "clench/io/graspit/eigengrasps.h"
#include "support/listening.h"
#include "support/shapes.h"
#include "temporary.h"
#include "told_robot.h"

using namespace clench;
using clench::test::TemporaryFolder;
using clench::test::ToldRobot;

using Sentences = std::vector<std::string>;

static Sentences suspicions_of(const BodySpec& body) {
  Sentences told;
  check_plausible_object(
      body, Place("a.obj"),
      test::Listening{.suspect = [&](const std::string& s) { told.push_back(s); }});
  return told;
}

static Sentences suspicions_of(const RobotSpec& robot) {
  Sentences told;
  check_plausible(robot, Place("a.cfg"),
                  test::Listening{.suspect = [&](const std::string& s) { told.push_back(s); }});
  return told;
}

static BodySpec box_of(double size) {
  BodySpec body;
  body.name = "box";
  body.shape = Shape::make(test::box(size, size / 2, size / 3));
  return body;
}

static RobotSpec robot_of(const LinkSpec& link, const JointSpec& joint) {
  RobotSpec robot;
  robot.base = box_of(0.1);
  robot.links.push_back(link);
  robot.links[0].joints.push_back(joint);
  return robot;
}

TEST_CASE("an object of less than a millimeter or more than 3 m is suspicious") {
  for (const double size : {0.00101, 0.1, 2.99}) CHECK(suspicions_of(box_of(size)).empty());
  CHECK(suspicions_of(box_of(7.5)) == Sentences{"a.obj: it is 7.5 m large: is its unit right?"});
  CHECK(suspicions_of(box_of(9e-4)) ==
        Sentences{"a.obj: it is 0.0009 m large: is its unit right?"});
  CHECK(suspicions_of(BodySpec()).empty());
}

TEST_CASE("a mass is suspicious when no metal is a tenth as dense, or air is denser") {
  BodySpec body = box_of(0.1);  // of 1/6 liter
  body.mass_from = Origin::file;
  for (const double mass : {0.0002, 0.3, 3.8, 40.0}) {
    body.mass = mass;
    CHECK(suspicions_of(body).empty());
  }
  body.mass = 300;  // grams read as kilograms
  const Sentences dense = {"a.obj: its mass of 300 kg makes 1.8e+06 kg/m^3: is its unit right?"};
  CHECK(suspicions_of(body) == dense);
  body.mass = 0.0001;
  CHECK(suspicions_of(body) ==
        Sentences{"a.obj: its mass of 0.0001 kg makes 0.6 kg/m^3: is its unit right?"});
  // nothing is reported about an assumed mass, or a surface that bounds nothing
  body.mass_from = Origin::assumed;
  CHECK(suspicions_of(body).empty());
  LinkSpec link;
  link.body = box_of(0.1);
  link.body.name = "thumb", link.body.mass_from = Origin::file, link.body.mass = 60;
  CHECK(suspicions_of(robot_of(link, {})) ==
        Sentences{"a.cfg: parts ten times denser than any metal, or lighter than air: 'thumb': is "
                  "the unit of their mass right?"});
}

TEST_CASE("an object without area is suspicious") {
  BodySpec body;
  body.shape = Shape::make({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}});
  CHECK(suspicions_of(body) == Sentences{"a.obj: none of its triangles has an area"});
}

TEST_CASE("a robot's parts of odd size or mass are named once for all") {
  LinkSpec link;
  link.body = box_of(24);
  link.body.mass = 246'000;
  RobotSpec robot = robot_of(link, {.min = -1, .max = 1});
  link.body = box_of(5e-4);
  robot.links.push_back(link);
  CHECK(suspicions_of(robot) ==
        Sentences{"a.cfg: parts smaller than a millimeter: 'box': is the unit of their geometry "
                  "right?",
                  "a.cfg: parts larger than 3 m: 'box': is the unit of their geometry right, or a "
                  "scale of 0.001 missing?",
                  "a.cfg: parts heavier than a tonne: 'box': is the unit of their mass or geometry "
                  "right?"});
}

TEST_CASE("a joint that turns more than four times is suspicious, one that slides is not") {
  LinkSpec link;
  link.body = box_of(0.1);
  const double turn = 2 * M_PI;
  CHECK(suspicions_of(robot_of(link, {.min = -4 * turn, .max = 4 * turn})).empty());
  CHECK(suspicions_of(robot_of(link, {.kind = JointKind::prismatic, .min = 0, .max = 90})).empty());
  CHECK(suspicions_of(robot_of(link, {.min = 0, .max = 90})) ==
        Sentences{"a.cfg: joints that turn more than four times: '0 of chain 0': is the unit of "
                  "their limits right?"});
  JointSpec named{.min = -90, .max = 0};
  named.name = "knuckle";
  CHECK(suspicions_of(robot_of(link, named)) ==
        Sentences{"a.cfg: joints that turn more than four times: 'knuckle': is the unit of their "
                  "limits right?"});
}

TEST_CASE("names beyond six are counted") {
  CHECK(some_names({"a", "b"}) == "'a', 'b'");
  CHECK(some_names({"a", "b", "c", "d", "e", "f", "g", "h"}) ==
        "'a', 'b', 'c', 'd', 'e', 'f' and 2 more");
}

TEST_CASE("text among the elements of a URDF is told, once for each kind of element") {
  const TemporaryFolder folder;
  const ToldRobot told(folder.write(
      "a.urdf",
      "<robot name='a'> loose &amp; lost\n<link name='b'>stray\n</link>\n<link name='c'>more</link>"
      "<joint name='j' type='fixed'><parent link='b'/><child link='c'/></joint></robot>"));
  CHECK(told.warned("a.urdf:1: text in <robot> is not used: 'loose & lost'"));
  CHECK(told.warned("a.urdf:2: text in <link> is not used: 'stray'"));
  CHECK_FALSE(told.warned("more"));
}

TEST_CASE("limits in degrees where radians are meant are suspicious") {
  const TemporaryFolder folder;
  const ToldRobot told(folder.write(
      "a.urdf",
      "<robot name='a'><link name='b'/><link name='c'/><joint name='j' type='revolute'><parent "
      "link='b'/><child link='c'/><axis xyz='0 0 1'/><limit lower='0' upper='90' effort='1' "
      "velocity='1'/></joint></robot>"));
  CHECK(
      told.warned("a.urdf: joints that turn more than four times: 'j': is the unit of their "
                  "limits right?"));
}

TEST_CASE("a center of mass or an inertia that contradicts the surface is suspicious") {
  const TemporaryFolder folder;
  const auto robot = [&](const std::string& inertial) {
    return ToldRobot(folder.write(
        "a.urdf", "<robot name='a'><link name='b'><inertial>" + inertial +
                      "</inertial><collision><geometry><box size='0.1 0.1 0.1'/></geometry>"
                      "</collision></link></robot>"));
  };
  const std::string fits = "<mass value='1'/><inertia ixx='0.002' iyy='0.002' izz='0.002'/>";
  CHECK(robot(fits).warnings.empty());
  CHECK(robot("<origin xyz='0 0 20'/>" + fits)
            .warned(
                "a.urdf: parts whose center of mass is far from their surface: 'a_b': is its unit "
                "right?"));
  CHECK(
      robot("<mass value='1'/><inertia ixx='2000' iyy='2000' izz='2000'/>")
          .warned("a.urdf: parts with the inertia of a much larger body: 'a_b': is its unit right, "
                  "and its mass?"));
  BodySpec body;
  body.shape = Shape::make(test::box(0.1, 0.1, 0.1));
  body.com = Eigen::Vector3d(0, 0, 5);
  Sentences told;
  const Diagnostics diagnostics =
      test::Listening{.suspect = [&](const std::string& s) { told.push_back(s); }};
  check_plausible_object(body, Place("mug.iv"), diagnostics);
  body.com.reset();
  body.inertia_per_mass = Eigen::Matrix3d::Identity();
  check_plausible_object(body, Place("mug.iv"), diagnostics);
  CHECK(told ==
        Sentences{"mug.iv: its center of mass is far from its surface: is its unit right?",
                  "mug.iv: its inertia is that of a much larger body: is it divided by the mass?"});
}

TEST_CASE("default values outside the limits are suspicious") {
  RobotSpec robot = read_robot("tests/data/two_finger/claw.cfg");
  robot.dofs[0].default_value = dof_range(robot, 0)[1] + 1;
  robot.dofs[0].name = "d";
  Sentences told;
  check_plausible(robot, Place("claw.cfg"),
                  test::Listening{.suspect = [&](const std::string& s) { told.push_back(s); }});
  CHECK(told ==
        Sentences{"claw.cfg: DOFs whose default value lies outside their limits, to which it is "
                  "moved: 'd': are limits or value exchanged?"});
}

TEST_CASE("a negative eigenvalue is suspicious, in text and in XML") {
  const TemporaryFolder folder;
  for (const auto& [name, text, place] :
       {std::tuple("a.egr", "DIMENSIONS 2\nEG\n-1\n1 0\nEG\n0.5\n0 1\n", "a.egr:2"),
        {"a.xml",
         "<EigenGrasps dimensions='2'>\n<EG><EigenValue value='-1'/><DimVals d0='1' d1='0'/></EG>\n"
         "<EG><EigenValue value='0.5'/><DimVals d0='0' d1='1'/></EG></EigenGrasps>",
         "a.xml:2"}}) {
    test::Warnings warnings;
    read_eigengrasps(folder.write(name, text), warnings.options());
    CHECK(warnings.list ==
          Sentences{fmt::format("{}: eigengrasp 1: its eigenvalue is -1, and variances are >= 0",
                                place)});
  }
}
